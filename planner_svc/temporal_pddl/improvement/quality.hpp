// How good a complete plan is: what the improvement minimizes, in this order.
#pragma once

#include <compare>
#include <cstddef>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl {

struct Quality {
  Ticks makespan = 0;     // the last start or end of an action
  Ticks busy = 0;         // all durations together: among equally short plans the one that does less
  std::size_t steps = 0;  // snap actions
  auto operator<=>(const Quality&) const = default;
};

// In the schedule of earliest times. The plan must be temporally consistent; actions that still run count
// with their starts only.
Quality quality_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check);

}  // namespace roci::planner::temporal_pddl
