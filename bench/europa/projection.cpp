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
void anchor(const FlightState& flight, Timelines& timelines) {
  const auto& definitions = flight.network.timelines;
  for (Index i = 0; i < definitions.size(); ++i) {
    const auto value = flight.values.find(i);
    if (value != flight.values.end()) timelines.observe(i, flight.now, value->second);
    for (const temporal::Token& token : flight.plan.tokens)
      if (token.timeline == "internal." + definitions[i].name)
        if (const auto number = adapter::number_of(definitions[i], token.held))
          timelines.observe(i, flight.now, *number);
  }
}

}  // namespace

Seen seen(const FlightState& flight, const std::vector<std::string>& tasks) {
  const model::Values values = model::priors(flight.network);
  Timelines timelines(flight.network.timelines, Time{0});
  temporal::timelines::TaskId next = 1;
  for (const temporal::PlanActivity& activity : flight.plan.activities) {
    const auto* const task = find_task(flight.network, activity.name);
    const auto known = flight.progress.find(activity.id);
    const bool over = known != flight.progress.end() && temporal::is_over(known->second.state);
    if (task == nullptr || over) continue;
    const bool runs = known != flight.progress.end() && known->second.started.has_value();
    const Time planned = std::max(flight.now, flight.plan.origin + activity.preferred_start);
    timelines.place(next++, model::footprint(*task, values), runs ? *known->second.started : planned);
  }
  anchor(flight, timelines);
  Seen out{flight.now, {}, {}};
  const Time end = flight.network.cycle.plan_end;
  out.projection = timelines.trajectory(flight.network.budget, flight.now, end);
  for (const std::string& id : tasks)
    if (const auto* const task = find_task(flight.network, id)) {
      const auto footprint = model::footprint(*task, values);
      const Time from = flight.now + flight.network.cycle.commit_window;
      out.valid[id] = timelines.valid_starts(footprint, {from, end - footprint.duration});
    }
  return out;
}

}  // namespace roci::bench::europa
