#include "bench/europa/projection.hpp"

#include <algorithm>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::bench::europa {

namespace model = planner::utility_htn::model;
namespace adapter = planner::utility_htn::adapter;
using temporal::Time, temporal::timelines::Index, temporal::timelines::Timelines;

namespace {

const model::Task* find_task(const model::Network& network, const std::string& id) {
  const auto found = std::ranges::find(network.tasks, id, &model::Task::id);
  return found == network.tasks.end() ? nullptr : &*found;
}

// A plan tells the values of timelines that nobody reports.
void anchor(const Standing& standing, Timelines& timelines) {
  const auto& definitions = standing.network.timelines;
  for (Index i = 0; i < definitions.size(); ++i) {
    const auto value = standing.values.find(i);
    if (value != standing.values.end()) timelines.observe(i, standing.now, value->second);
    for (const temporal::Token& token : standing.plan.tokens)
      if (token.timeline == "internal." + definitions[i].name)
        if (const auto number = adapter::number_of(definitions[i], token.held))
          timelines.observe(i, standing.now, *number);
  }
}

}  // namespace

Seen seen(const Standing& standing, const std::vector<std::string>& tasks) {
  const model::Values values = model::priors(standing.network);
  Timelines timelines(standing.network.timelines, Time{0});
  temporal::timelines::TaskId next = 1;
  for (const temporal::PlanActivity& activity : standing.plan.activities) {
    const auto* const task = find_task(standing.network, activity.name);
    const auto known = standing.progress.find(activity.id);
    const bool over = known != standing.progress.end() && temporal::is_over(known->second.state);
    if (task == nullptr || over) continue;
    const bool runs = known != standing.progress.end() && known->second.started.has_value();
    const Time planned = std::max(standing.now, standing.plan.origin + activity.preferred_start);
    timelines.place(next++, model::footprint(*task, values), runs ? *known->second.started : planned);
  }
  anchor(standing, timelines);
  Seen out{standing.now, {}, {}};
  const Time end = standing.network.cycle.plan_end;
  out.projection = timelines.trajectory(standing.network.budget, standing.now, end);
  for (const std::string& id : tasks)
    if (const auto* const task = find_task(standing.network, id)) {
      const auto footprint = model::footprint(*task, values);
      const Time from = standing.now + standing.network.cycle.commit_window;
      out.valid[id] = timelines.valid_starts(footprint, {from, end - footprint.duration});
    }
  return out;
}

}  // namespace roci::bench::europa
