#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

#include <cmath>
#include <stdexcept>

namespace roci::planner::utility_htn::search {

using model::TaskIndex;
using temporal::ImpactKind, temporal::ImpactWhen;
using temporal::timelines::Kind;

Toy::Toy() {
  network.ranks = {"mission", "analysis", "default"};
  network.batches = {"all"};
  network.budget = kBattery;
  network.timelines = {{"battery", Kind::cumulative_rate, {}, 1000, 0, 1000},
                       {"arm", Kind::atomic, {}, 0, 0, 1},
                       {"phase", Kind::state, {"landed", "ready", "done"}, 0, -INFINITY, INFINITY, false}};
}

TaskIndex Toy::task(const std::string& id, double seconds, double energy, std::vector<double> scores,
                    bool arm, bool is_template) {
  model::Task& added = network.tasks.emplace_back();
  added.id = id;
  added.is_template = is_template;
  added.duration = {seconds, {}, 1};
  for (const double score : scores) added.utility.push_back({score, {}, 1});
  added.impacts.push_back({kBattery, ImpactKind::delta, ImpactWhen::at_start, {-energy, {}, 1}});
  if (arm) added.impacts.push_back({kArm, ImpactKind::delta, ImpactWhen::during, {1, {}, 1}});
  return static_cast<TaskIndex>(network.tasks.size() - 1);
}

TaskIndex Toy::parent(const std::string& id, const std::vector<std::vector<TaskIndex>>& decompositions) {
  model::Task& added = network.tasks.emplace_back();
  added.id = id;
  for (const std::vector<TaskIndex>& tasks : decompositions) {
    model::Decomposition& way = added.decompositions.emplace_back();
    way.name = std::string(1, static_cast<char>('a' + added.decompositions.size() - 1));
    for (const TaskIndex each : tasks) way.subtasks.push_back({each});
  }
  return static_cast<TaskIndex>(network.tasks.size() - 1);
}

void Toy::close() {
  values = model::priors(network);
  chains = flattening::flatten(network);
  now.clear();
  for (const auto& timeline : network.timelines) now.push_back(timeline.initial);
  timelines.emplace_back(network.timelines);
}

Problem Toy::problem(double budget) {
  Problem out{network, values, chains, sums, earliest, timelines.at(0)};
  out.until = temporal::seconds(1000);
  out.budget = budget;
  out.timelines_now = now;
  return out;
}

std::uint32_t Toy::chain(const std::string& name) const {
  for (std::uint32_t index = 0; index < chains.chains.size(); ++index) {
    if (chains.chains[index].name == name) return index;
  }
  throw std::invalid_argument("no chain " + name);
}

std::vector<std::string> Toy::names(const Plan& plan) const {
  std::vector<std::string> out;
  for (const Placed& placed : plan.placed) out.push_back(chains.chains[placed.chain].name);
  return out;
}

temporal::Time Toy::start(const Plan& plan, const std::string& name, std::size_t link) const {
  for (const Placed& placed : plan.placed) {
    if (chains.chains[placed.chain].name == name) return placed.starts.at(link);
  }
  throw std::invalid_argument("not planned: " + name);
}

}  // namespace roci::planner::utility_htn::search
