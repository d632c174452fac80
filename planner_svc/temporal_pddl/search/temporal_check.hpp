// Can the steps of a plan be scheduled (R25, R31)?
#pragma once

#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/constraints/time_bounds.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl {

class TemporalCheck {
 public:
  TemporalCheck(const Task& task, Duration epsilon) : bounds_(task, epsilon) {}

  // The least time of each step; none if the plan is temporally inconsistent.
  const std::vector<Ticks>* earliest(const PlanPrefix& prefix);
  // The greatest time of each step, kNever if there is none; for a consistent plan.
  std::vector<Ticks> latest(const PlanPrefix& prefix) const;

  // The network over the steps alone, without absolute times.
  static Stn network(const PlanPrefix& prefix);
  // The bounds of a step from timed literals and the plan's deadline; kNever: none from above.
  Ticks lower_bound(const PlanPrefix& prefix, std::size_t step) const {
    return bounds_.earliest(prefix.steps[step]);
  }
  Ticks upper_bound(const PlanPrefix& prefix, std::size_t step) const;

 private:
  static void fill(const PlanPrefix& prefix, Stn& network);

  TimeBounds bounds_;
  Stn network_;
  std::vector<Ticks> times_;
};

}  // namespace roci::planner::temporal_pddl
