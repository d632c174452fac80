#include "planner_svc/temporal_pddl/improvement/action_elimination.hpp"

#include <array>
#include <utility>

namespace roci::planner::temporal_pddl::improvement {

using call::SearchLimits;
using search::PlanPrefix;
using task::SnapKind;
using task::Task;

void eliminate_useless_actions(const Task& task, PlanPrefix& plan, PlanReplay& replay, std::size_t max_steps,
                               SearchLimits& limits) {
  PlanQuality best = quality_of(task, plan, replay.check());
  std::size_t taken = 0;
  for (std::uint32_t i = 0; i < plan.steps.size() && taken < max_steps;) {
    const SnapKind kind = task.snaps[plan.steps[i]].kind;
    if (kind == SnapKind::start || kind == SnapKind::instant) {
      limits.poll();
      taken += plan.steps.size();
      const std::array<std::uint32_t, 1> dropped{i};
      auto shorter = replay.run(plan.steps, dropped);
      const PlanQuality quality = shorter ? quality_of(task, *shorter, replay.check()) : best;
      if (quality < best) {
        best = quality;
        plan = std::move(*shorter);
        continue;
      }
    }
    ++i;
  }
}

}  // namespace roci::planner::temporal_pddl::improvement
