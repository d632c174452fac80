// A plan on timelines at some time of a flight: what is projected,
// and where a task could be placed (MEXEC, figure 7; R75).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/projection.hpp"
#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::bench::europa {

/// Is how things stand: the plan that is executed, how far it has come, and the true values of timelines.
struct FlightState {
  const planner::utility_htn::model::Network& network;
  const temporal::FlexiblePlan& plan;
  const temporal::Progress& progress;
  std::map<temporal::timelines::Index, double> values;  ///< of those that are reported and were changed
  temporal::Time now{0};
};

/// Is what figure 7 shows of it.
struct Seen {
  temporal::Time now{0};
  std::vector<temporal::timelines::Vertex> projection;  ///< of the budget, from now to the end of the plan
  std::map<std::string, std::vector<temporal::timelines::Interval>> valid;  ///< starts, by task
};

/// Puts what is planned and what runs onto timelines that are anchored now,
/// and asks when each of these tasks could start.
Seen seen(const FlightState& flight, const std::vector<std::string>& tasks);

}  // namespace roci::bench::europa
