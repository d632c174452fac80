#include "planner_svc/temporal_pddl/improvement/plan_replay.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl::improvement {

using search::NodeId, search::PlanPrefix, search::Successor;
using task::ActionCompression, task::SnapId, task::SnapKind, task::Task;
using temporal::Duration;

PlanReplay::PlanReplay(const Task& task, Duration epsilon)
    : task_(task),
      check_(task, epsilon),
      store_(task.layout.words()),
      builder_(task, store_, check_, epsilon, ActionCompression::where_safe),
      goal_(task, check_, epsilon) {}

bool PlanReplay::take(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped, Successor& at) {
  store_.clear();
  at.state = task_.initial_state;
  at.prefix.node = store_.add(at.state, NodeId(), {}, {});
  for (std::uint32_t i = 0; i < steps.size(); ++i) {
    const SnapId step = steps[i];
    const SnapKind kind = task_.snaps[step].kind;
    // This is the end of an action that was left out, or an end that the start has brought along.
    if (kind == SnapKind::end && std::ranges::count(at.prefix.running_actions, task_.snaps[step].action) == 0)
      continue;
    const bool starts = kind == SnapKind::start || kind == SnapKind::instant;
    if (starts && std::ranges::count(dropped, i) > 0) continue;
    if (!builder_.applicable(at.prefix, step) || !builder_.advance_unscheduled(step, at)) {
      if (starts) continue;
      return false;
    }
    at.prefix.node = store_.add(at.state, at.prefix.node, at.transition, {});
  }
  return true;
}

std::optional<PlanPrefix> PlanReplay::rest(std::span<const SnapId> steps,
                                           std::span<const std::uint32_t> dropped) {
  Successor at;
  if (!take(steps, dropped, at) || !check_.earliest(at.prefix)) return std::nullopt;
  return std::move(at.prefix);
}

std::optional<PlanPrefix> PlanReplay::run(std::span<const SnapId> steps,
                                          std::span<const std::uint32_t> dropped) {
  Successor at;
  if (!take(steps, dropped, at)) return std::nullopt;
  if (!goal_.complete(at.state, at.prefix)) return std::nullopt;
  return std::move(at.prefix);
}

}  // namespace roci::planner::temporal_pddl::improvement
