// How good a complete plan is: what the improvement minimizes, in this order.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl {

struct Quality {
  std::int64_t metric = 0;  // Task::metric in millionths; 0 where that is the time alone
  Ticks makespan = 0;       // the last start or end of an action
  Ticks busy = 0;           // all durations together: among equally short plans the one that does less
  std::size_t steps = 0;    // snap actions
  auto operator<=>(const Quality&) const = default;
};

// In the schedule of earliest times. The plan must be temporally consistent; actions that still run count
// with their starts only.
Quality quality_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check);

// The times of all starts together: of two plans alike in quality, the one with less lets nothing wait in
// vain.
Ticks starts_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check);

// Is the quality of a plan at least that of its beginning, whatever comes in between?
bool only_grows(const Task& task);

// The metric of a plan of this length, as the problem states it.
double metric_of(const Task& task, const PlanPrefix& plan, Ticks makespan);

}  // namespace roci::planner::temporal_pddl
