#include "planner_svc/temporal_pddl/improvement/quality.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

Quality quality_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check) {
  const std::vector<Ticks>& times = *check.earliest(plan);
  Quality result;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (task.snaps[plan.steps[i]].kind == SnapKind::timed_literal) continue;
    ++result.steps;
    result.makespan = std::max(result.makespan, times[i]);
    result.busy += times[i] - times[plan.start_of[i]];
  }
  return result;
}

}  // namespace roci::planner::temporal_pddl
