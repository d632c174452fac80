#include "planner_svc/utility_htn/model/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/complaints.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::model {

using temporal::timelines::Kind;

namespace {

void check_names_once(const std::string& kind, const std::vector<std::string>& names,
                      Complaints& complaints) {
  std::set<std::string_view> seen;
  for (const std::string& name : names) {
    complaints.name(kind, name);
    if (!seen.insert(name).second)
      complaints.error(kind + " '" + name + "' stands there twice", "rename one");
  }
}

void check_head(Complaints& complaints) {
  const Network& network = complaints.network;
  complaints.about(Part::network, 0);
  complaints.name("the network's name", network.name);
  complaints.more_than("ranks", network.ranks.size(), kMostRanks);
  complaints.more_than("batches", network.batches.size(), kMostBatches);
  complaints.more_than("parameters", network.parameters.size(), kMostParameters);
  complaints.more_than("timelines", network.timelines.size(), kMostTimelines);
  complaints.more_than("tasks", network.tasks.size(), kMostTasks);
  if (network.ranks.empty()) complaints.error("it has no ranks of utility", "list them, the highest first");
  if (network.tasks.empty()) complaints.error("it has no tasks", "add some");
  check_names_once("rank", network.ranks, complaints);
  check_names_once("batch", network.batches, complaints);
  if (network.budget >= network.timelines.size()) {
    complaints.error("its budget is no timeline", "name the timeline that is spent, as the battery is");
  } else if (const auto& budget = network.timelines[network.budget];
             budget.kind != Kind::cumulative && budget.kind != Kind::cumulative_rate) {
    complaints.error("its budget '" + budget.name + "' is of kind " + std::string(to_text(budget.kind)),
                     "a budget is of kind cumulative or cumulative_rate");
  }
  if (network.exploration_bound == 0)
    complaints.error("its exploration bound is 0, so that nothing would ever be planned", "raise it");
}

void check_parameters(Complaints& complaints) {
  const auto& parameters = complaints.network.parameters;
  std::map<std::string_view, std::size_t> seen;
  for (std::size_t index = 0; index < parameters.size(); ++index) {
    const Parameter& parameter = parameters[index];
    complaints.about(Part::parameter, index);
    complaints.name("the parameter's name", parameter.name);
    complaints.text("its source", parameter.source);
    if (!seen.emplace(parameter.name, index).second)
      complaints.error("the name is that of another parameter", "rename one");
    if (!std::isfinite(parameter.lowest) || !std::isfinite(parameter.highest) ||
        parameter.lowest > parameter.highest) {
      complaints.error("its range " + to_text(parameter.lowest) + " .. " + to_text(parameter.highest) +
                           " is none that a measured value could be held against",
                       "give it two numbers, the lower first");
    } else if (!parameter.permits(parameter.prior)) {
      complaints.error("its value " + to_text(parameter.prior) + " is not within its range " +
                           to_text(parameter.lowest) + " .. " + to_text(parameter.highest),
                       "mend the value or widen the range");
    }
  }
}

void check_cycle(Complaints& complaints) {
  using temporal::to_text;
  const CycleWindows& cycle = complaints.network.cycle;
  complaints.about(Part::network, kCycleOfNetwork);
  if (cycle.worst_cycle <= temporal::Duration{0})
    complaints.error("its worst cycle is not above 0", "write what was measured");
  if (cycle.process_interval <= cycle.worst_cycle)
    complaints.error("the planner would start every " + to_text(cycle.process_interval) +
                         ", and a cycle takes up to " + to_text(cycle.worst_cycle),
                     "make the process interval longer than the worst cycle");
  if (cycle.commit_window < cycle.process_interval)
    complaints.error("its commit window of " + to_text(cycle.commit_window) +
                         " is shorter than the process interval of " + to_text(cycle.process_interval) +
                         ", so that tasks would start uncommitted",
                     "make it at least as long");
  if (cycle.scheduling_window <= cycle.commit_window)
    complaints.error("its scheduling window of " + to_text(cycle.scheduling_window) +
                         " ends with the commit window, behind which tasks are placed",
                     "make it longer, or leave it out");
  if (cycle.plan_end <= temporal::Time{0}) complaints.error("its plan ends before it begins", "mend the end");
  for (const temporal::Duration window :
       {cycle.process_interval, cycle.commit_window, cycle.scheduling_window, cycle.plan_end})
    if (temporal::bounded(window) && window > kLongestDuration)
      complaints.error("a window of " + to_text(window) + " is longer than " + to_text(kLongestDuration),
                       "shorten it, or leave it out");
}

void check_subway(Complaints& complaints) {
  const Network& network = complaints.network;
  const SubwayMap& map = network.subway;
  complaints.about(Part::network, kSubwayOfNetwork);
  if (map.sites.empty()) return;
  if (map.rank >= network.ranks.size())
    complaints.error("its subway map is enforced at a rank that is not there", "name one of its ranks");
  if (map.most_samples == 0)
    complaints.error("its subway map permits no sample at a site", "permit one at least");
  complaints.more_than("sites", map.sites.size(), kMostInList);
  static const std::vector<std::string> signatures{"unknown", "negative", "positive"};
  for (std::size_t index = 0; index < map.sites.size(); ++index) {
    const Site& site = map.sites[index];
    complaints.about(Part::site, index);
    complaints.name("the site's name", site.name);
    complaints.amount("its value", site.value, 0, 1);
    complaints.more_than("targets", site.targets.size(), kMostInList);
    if (site.targets.empty()) complaints.error("it has no target", "list its targets, or leave it out");
    for (const Target& target : site.targets) {
      complaints.amount("a target's visual weight", target.visual, 0, 1);
      if (target.task >= network.tasks.size())
        complaints.error("a target names a task that is not there");
      else if (network.tasks[target.task].is_template)
        complaints.error("a target's task '" + network.tasks[target.task].id + "' is a template",
                         "name a task that is requested");
      if (target.signature >= network.timelines.size())
        complaints.error("a target names a timeline that is not there");
      else if (network.timelines[target.signature].states != signatures)
        complaints.error("the signature '" + network.timelines[target.signature].name +
                             "' does not have the states unknown, negative, positive",
                         "give it these, in this order");
    }
  }
}

// What runs over the lists of all tasks together.
void check_size(Complaints& complaints) {
  std::size_t items = 0;
  for (const Task& task : complaints.network.tasks) {
    items += task.impacts.size() + task.constraints.size() + task.commands.size() + task.products.size() +
             task.control.skip_if.size() + task.learns.size();
    for (const temporal::PlanCommand& command : task.commands) items += command.arguments.size();
    for (const Decomposition& decomposition : task.decompositions)
      items += 1 + decomposition.when.size() + decomposition.subtasks.size();
  }
  complaints.about(Part::network, 0);
  complaints.more_than("impacts, constraints, commands, products and subtasks", items, kMostItems);
}

}  // namespace

std::vector<Fault> check(const Network& network) {
  std::vector<Fault> out;
  Complaints complaints(network, out);
  check_head(complaints);
  check_parameters(complaints);
  check_timelines(complaints);
  std::map<std::string_view, std::size_t> seen;
  for (std::size_t index = 0; index < network.tasks.size(); ++index) {
    complaints.about(Part::task, index);
    if (!seen.emplace(network.tasks[index].id, index).second)
      complaints.error("the id is that of another task", "rename one");
    check_task(network.tasks[index], complaints);
  }
  check_cycle(complaints);
  check_subway(complaints);
  check_size(complaints);
  if (usable(out)) check_hierarchy(complaints);
  return out;
}

bool usable(const std::vector<Fault>& faults) { return std::ranges::all_of(faults, &Fault::warning); }

std::string to_text(const Fault& fault, const Network& network) {
  const auto named = [](const char* kind, const std::string& name) {
    return std::string(kind) + " '" + name + "': ";
  };
  std::string out;
  switch (fault.part) {
    case Part::network:
      out = named("network", network.name);
      break;
    case Part::parameter:
      out = named("parameter", network.parameters.at(fault.index).name);
      break;
    case Part::timeline:
      out = named("timeline", network.timelines.at(fault.index).name);
      break;
    case Part::task:
      out = named("task", network.tasks.at(fault.index).id);
      break;
    case Part::site:
      out = named("site", network.subway.sites.at(fault.index).name);
      break;
  }
  return out + fault.what + (fault.remedy.empty() ? "" : "; " + fault.remedy);
}

}  // namespace roci::planner::utility_htn::model
