#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/complaints.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::model {

using temporal::ImpactKind, temporal::ImpactWhen, temporal::to_text;
using temporal::timelines::Definition, temporal::timelines::Kind, temporal::timelines::Phase;

namespace {

constexpr double kHuge = std::numeric_limits<double>::max();

// What the kind of a timeline forbids; empty: nothing.
std::string forbidden(const Impact& impact, Kind kind) {
  if (kind == Kind::state && impact.kind != ImpactKind::assign) return "a state is set, not counted";
  if (kind == Kind::cumulative && impact.kind == ImpactKind::rate)
    return "only a timeline of kind cumulative_rate runs at a rate";
  if ((kind == Kind::atomic || kind == Kind::claimable) &&
      (impact.kind != ImpactKind::delta || impact.moment != ImpactWhen::during))
    return "what is atomic or claimable is taken while the task runs, and given back";
  if (impact.kind == ImpactKind::assign && impact.moment == ImpactWhen::during)
    return "a value is set at the start or at the end";
  return "";
}

void check_impact(const Impact& impact, Complaints& complaints) {
  const Network& network = complaints.network;
  if (impact.timeline >= network.timelines.size())
    return complaints.error("an impact names timeline number " + std::to_string(impact.timeline) + " of " +
                            std::to_string(network.timelines.size()));
  const Definition& timeline = network.timelines[impact.timeline];
  const std::string kind = "its impact on '" + timeline.name + "'";
  const std::string why = forbidden(impact, timeline.kind);
  if (!why.empty())
    return complaints.error(
        kind + " is none of a timeline of kind " + std::string(to_text(timeline.kind)) + ": " + why,
        "change the impact or the timeline's kind");
  if (timeline.kind == Kind::state || timeline.kind == Kind::atomic) {
    const double highest =
        timeline.kind == Kind::atomic ? 1 : static_cast<double>(timeline.states.size()) - 1;
    const double amount = impact.amount.constant;
    if (impact.amount.parameter)
      complaints.error(kind + " depends on a parameter", "write what it is");
    else if (!(amount >= 0 && amount <= highest) || amount != std::floor(amount) ||
             (timeline.kind == Kind::atomic && amount != 1))
      complaints.error(kind + " is out of range: " + to_text(amount),
                       timeline.kind == Kind::atomic ? "take 1" : "name one of its states");
    return;
  }
  const bool assign = impact.kind == ImpactKind::assign;
  complaints.amount(kind, impact.amount, assign ? timeline.lowest : -kHuge,
                    assign ? timeline.highest : kHuge);
  if (impact.kind != ImpactKind::delta) return;
  if (impact.amount.parameter && *impact.amount.parameter >= complaints.known.size()) return;
  const double amount = std::abs(evaluate(impact.amount, complaints.known));
  if (amount > timeline.highest - timeline.lowest)
    complaints.error(kind + " is out of range: " + to_text(amount) +
                         ", and from one end of the range to the other it is " +
                         to_text(timeline.highest - timeline.lowest),
                     "mend the amount or the range");
}

void check_command(const temporal::PlanCommand& command, Complaints& complaints) {
  complaints.name("a command's owner", command.owner);
  complaints.name("a command's name", command.command_name);
  complaints.text("a command's robot", command.robot);
  complaints.text("a command's component", command.subsystem);
  complaints.more_than("arguments of a command", command.arguments.size(), kMostInList);
  for (const temporal::Property& argument : command.arguments) {
    complaints.name("an argument's name", argument.name);
    complaints.text("an argument's value", argument.value);
  }
  if (command.answer_within <= temporal::Duration{0})
    complaints.error("a command is to be answered within " + to_text(command.answer_within),
                     "give the owner time, or leave it out");
}

void check_times(const Task& task, Complaints& complaints) {
  const temporal::Duration none{0};
  const bool preferred = temporal::bounded(task.preferred_start);
  if (task.fixed && !preferred) complaints.error("it is fixed without a time", "say when it starts");
  if (task.opens < none || task.opens > kLongestDuration)
    complaints.error("its window opens at " + to_text(task.opens), "mend the window");
  if (temporal::bounded(task.closes) ? task.closes <= task.opens || task.closes > kLongestDuration
                                     : task.closes < none)
    complaints.error("its window closes before it opens, or never opens", "mend the window");
  if (preferred && (task.preferred_start < task.opens || task.preferred_start > kLongestDuration ||
                    (temporal::bounded(task.closes) && task.preferred_start > task.closes)))
    complaints.error("it would start at " + to_text(task.preferred_start) + ", outside of its window",
                     "mend the start or the window");
  if (!preferred && task.preferred_start != temporal::no_bound)
    complaints.error("its start is no time", "mend it");
  complaints.amount("its duration in seconds", task.duration, 0, temporal::to_seconds(kLongestDuration));
  if (!temporal::bounded(task.closes)) return;
  if (task.duration.parameter && *task.duration.parameter >= complaints.known.size()) return;
  if (temporal::to_seconds(task.opens) + evaluate(task.duration, complaints.known) >
      temporal::to_seconds(task.closes))
    complaints.error("it does not fit into its window", "mend the duration or the window");
}

void check_control(const Task& task, Complaints& complaints) {
  const Control& control = task.control;
  if (control.wait_timeout < temporal::Duration{0} ||
      (temporal::bounded(control.wait_timeout) && control.wait_timeout > kLongestDuration))
    complaints.error("it waits for " + to_text(control.wait_timeout), "mend the wait");
  if (control.answer_within <= temporal::Duration{0})
    complaints.error("its command is to be answered within " + to_text(control.answer_within),
                     "give the owner time, or leave it out");
  complaints.more_than("conditions to skip it", control.skip_if.size(), kMostInList);
  for (const auto& constraint : control.skip_if) {
    complaints.constraint("the condition to skip it", constraint);
    if (constraint.phase != Phase::pre)
      complaints.error("a condition to skip it is not one of its start", "make it one");
  }
}

void check_contingency(const Contingency& contingency, Complaints& complaints) {
  const auto& tasks = complaints.network.tasks;
  complaints.more_than("requests on failure", contingency.requests.size(), kMostInList);
  complaints.more_than("withdrawals on failure", contingency.withdraws.size(), kMostInList);
  for (const TaskIndex index : contingency.requests) {
    if (index >= tasks.size())
      complaints.error("on failure it requests a task that is not there");
    else if (!tasks[index].is_template)
      complaints.error("on failure it requests '" + tasks[index].id + "', which is requested already",
                       "make that a template");
  }
  for (const TaskIndex index : contingency.withdraws) {
    if (index >= tasks.size())
      complaints.error("on failure it withdraws a task that is not there");
    else if (tasks[index].is_template)
      complaints.error(
          "on failure it withdraws '" + tasks[index].id + "', which is a template and not requested",
          "name a task that is");
  }
}

void check_products(const Task& task, Complaints& complaints) {
  complaints.more_than("products", task.products.size(), kMostInList);
  std::set<std::string_view> names;
  for (const Product& product : task.products) {
    complaints.name("a product's name", product.name);
    if (!names.insert(product.name).second)
      complaints.error("product '" + product.name + "' stands there twice", "rename one");
    complaints.amount("the size of '" + product.name + "' in bytes", product.bytes, 0, kMostProductBytes);
    const auto& scores = product.utility.scores();
    if (scores.size() > complaints.network.ranks.size())
      complaints.error("product '" + product.name + "' has more scores than there are ranks",
                       "leave the last out");
    for (const double score : scores)
      if (!(score >= 0 && score <= 1))
        complaints.error(
            "a score of product '" + product.name + "' is " + to_text(score) + ", which is not within 0 .. 1",
            "scale it");
  }
}

void check_primitive(const Task& task, Complaints& complaints) {
  complaints.more_than("commands", task.commands.size(), kMostInList);
  complaints.more_than("impacts", task.impacts.size(), kMostInList);
  complaints.more_than("constraints", task.constraints.size(), kMostInList);
  for (const temporal::PlanCommand& command : task.commands) check_command(command, complaints);
  if (task.response) check_command(*task.response, complaints);
  for (const Impact& impact : task.impacts) check_impact(impact, complaints);
  for (const auto& constraint : task.constraints) complaints.constraint("a constraint", constraint);
  check_times(task, complaints);
  check_control(task, complaints);
  if (task.contingency) check_contingency(*task.contingency, complaints);
  if (task.utility.size() > complaints.network.ranks.size())
    complaints.error("it has more scores than there are ranks", "leave the last out");
  for (const Amount& score : task.utility) complaints.amount("a score of its utility", score, 0, 1);
  check_products(task, complaints);
  complaints.more_than("measures to learn", task.learns.size(), kMostInList);
  for (const Learns& learns : task.learns) {
    if (learns.parameter >= complaints.network.parameters.size())
      complaints.error("it learns a parameter that is not there");
    if (learns.measure == Measure::value) complaints.name("result", learns.result);
    if (learns.measure != Measure::duration_s && task.commands.empty())
      complaints.warning("it learns from the results of commands and has none",
                         "give it a command, or let it learn its duration alone");
  }
}

void check_parent(const Task& task, Complaints& complaints) {
  const Network& network = complaints.network;
  Task bare;  // all that a parent has
  bare.id = task.id;
  bare.name = task.name;
  bare.priority = task.priority;
  bare.is_template = task.is_template;
  bare.batch = task.batch;
  bare.fixed = task.fixed;
  bare.preferred_start = task.preferred_start;
  bare.opens = task.opens;
  bare.closes = task.closes;
  bare.decompositions = task.decompositions;
  if (!(bare == task))
    complaints.error(
        "it has decompositions, and duration, commands, impacts, constraints or the like of its own",
        "give those to one of its subtasks");
  check_times(bare, complaints);
  complaints.more_than("decompositions", task.decompositions.size(), kMostInList);
  std::set<std::string_view> names;
  for (const Decomposition& decomposition : task.decompositions) {
    const std::string kind = "decomposition '" + decomposition.name + "'";
    complaints.name("a decomposition's name", decomposition.name);
    if (!names.insert(decomposition.name).second)
      complaints.error(kind + " stands there twice", "rename one");
    if (decomposition.subtasks.empty()) complaints.error(kind + " is empty", "list its subtasks");
    complaints.more_than("subtasks of " + kind, decomposition.subtasks.size(), kMostInList);
    complaints.more_than("conditions of " + kind, decomposition.when.size(), kMostInList);
    for (const auto& constraint : decomposition.when) {
      complaints.constraint("a condition of " + kind, constraint);
      if (constraint.phase != Phase::pre)
        complaints.error("a condition of " + kind + " is not one of its start", "make it one");
    }
    for (std::size_t i = 0; i < decomposition.subtasks.size(); ++i) {
      const Subtask& subtask = decomposition.subtasks[i];
      if (subtask.task >= network.tasks.size()) {
        complaints.error(kind + " names task number " + std::to_string(subtask.task) + " of " +
                         std::to_string(network.tasks.size()));
        continue;
      }
      const std::string& id = network.tasks[subtask.task].id;
      if (subtask.shortest_gap < temporal::Duration{0} || subtask.longest_gap < subtask.shortest_gap ||
          subtask.shortest_gap > kLongestDuration ||
          (temporal::bounded(subtask.longest_gap) && subtask.longest_gap > kLongestDuration))
        complaints.error("the gap before '" + id + "' in " + kind + " is none: from " +
                             to_text(subtask.shortest_gap) + " to " + to_text(subtask.longest_gap),
                         "write the shorter time first");
      if (i == 0 &&
          (subtask.shortest_gap != temporal::Duration{0} || subtask.longest_gap != temporal::no_bound))
        complaints.error(
            "the first subtask '" + id + "' of " + kind + " has a gap before it, and there is nothing",
            "leave it out");
    }
  }
}

}  // namespace

void check_task(const Task& task, Complaints& complaints) {
  complaints.name("the task's id", task.id);
  complaints.text("its name", task.name);
  if (task.batch >= std::max<std::size_t>(1, complaints.network.batches.size()))
    complaints.error("it is in a batch that is not there", "name one of the batches");
  if (task.primitive()) {
    check_primitive(task, complaints);
  } else {
    check_parent(task, complaints);
  }
}

}  // namespace roci::planner::utility_htn::model
