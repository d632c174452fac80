#include "planner_svc/temporal_pddl/improvement/replay.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl {

std::optional<PlanPrefix> Replay::run(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped) {
  StateStore store(task_.layout.words());
  SuccessorBuilder builder(task_, store, check_, epsilon_, ActionSteps::as_needed);
  Successor at, next;
  at.state = task_.initial_state;
  at.prefix.node = store.add(at.state, NodeId(), {}, {});
  for (std::uint32_t i = 0; i < steps.size(); ++i) {
    const SnapId step = steps[i];
    const SnapKind kind = task_.snaps[step].kind;
    // The end of an action that was left out, or that the start has brought along.
    if (kind == SnapKind::end && std::ranges::count(at.prefix.running_actions, task_.snaps[step].action) == 0)
      continue;
    const bool starts = kind == SnapKind::start || kind == SnapKind::instant;
    if (starts && std::ranges::count(dropped, i) > 0) continue;
    if (!builder.applicable(at.prefix, step) || !builder.extend(at.prefix, step, next)) {
      if (starts) continue;
      return std::nullopt;
    }
    next.prefix.node = store.add(next.state, at.prefix.node, next.transition, {});
    std::swap(at, next);
  }
  GoalTest goal(task_, check_, epsilon_);
  if (!goal.complete(at.state, at.prefix)) return std::nullopt;
  return std::move(at.prefix);
}

}  // namespace roci::planner::temporal_pddl
