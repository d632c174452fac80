// The quality of a complete plan is what the improvement minimizes, in the order of the members.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Compares plans: the lower one is better.
struct PlanQuality {
  std::int64_t metric = 0;         ///< Task::metric in millionths; it is 0 where that is the time alone
  temporal::Duration makespan{0};  ///< the time of the last start or end of an action
  /// Sums all durations: among equally short plans the one that does less is better.
  temporal::Duration busy{0};
  std::size_t steps = 0;  ///< the number of snap actions
  auto operator<=>(const PlanQuality&) const = default;
};

/// Returns the quality in the schedule of earliest times. The plan must be temporally consistent; actions
/// that still run count with their starts only.
PlanQuality quality_of(const task::Task& task, const search::PlanPrefix& plan, search::TemporalCheck& check);

/// Returns the sum of the times of all starts: of two plans alike in quality, the one with less lets nothing
/// wait in vain.
temporal::Duration starts_of(const task::Task& task, const search::PlanPrefix& plan,
                             search::TemporalCheck& check);

/// Returns whether the quality of a plan is at least that of its beginning, whatever comes in between.
bool only_grows(const task::Task& task);

/// Returns the metric of a plan of this length, as the problem states it.
double metric_of(const task::Task& task, const search::PlanPrefix& plan, temporal::Duration makespan);

}  // namespace roci::planner::temporal_pddl::improvement
