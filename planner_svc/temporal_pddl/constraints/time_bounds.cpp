#include "planner_svc/temporal_pddl/constraints/time_bounds.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

namespace {

std::uint32_t first_from(const std::vector<std::uint32_t>& steps, std::uint32_t from,
                         std::uint32_t otherwise) {
  const auto found = std::ranges::lower_bound(steps, from);
  return found == steps.end() ? otherwise : std::min(*found, otherwise);
}

}  // namespace

TimeBounds::TimeBounds(const Task& task, Duration epsilon)
    : task_(task),
      epsilon_(epsilon),
      windows_(task.windows),
      timed_(task.variables()),
      timed_change_(task.variables()),
      touched_(task.snaps.size(), false) {
  for (std::uint32_t i = 0; i < task.timed_steps.size(); ++i) {
    const TimedStep& timed = task.timed_steps[i];
    windows_[timed.snap] = {timed.time, timed.time};
    for (const VariableId variable : task.writes[timed.snap]) {
      timed_[variable].push_back(i);
      const bool adds = std::ranges::any_of(task.adds[timed.snap],
                                            [&](FactId fact) { return task.variable(fact) == variable; });
      if (!adds) timed_change_[variable].push_back(i);
    }
  }
  const auto touched = [&](VariableId variable) { return !timed_[variable].empty(); };
  for (std::size_t i = 0; i < task.snaps.size(); ++i) {
    const SnapId snap(i);
    touched_[snap] =
        std::ranges::any_of(task.reads[snap], touched) || std::ranges::any_of(task.writes[snap], touched);
  }
  for (const Action& action : task.actions) {
    const ActionId id = task.snaps[action.start].action;
    if (std::ranges::any_of(task.invariant_reads[id], touched))
      touched_[action.start] = touched_[action.end] = true;
    auto& start = windows_[action.start];
    const auto& end = windows_[action.end];
    if (end.close != kUnbounded) start.close = std::min(start.close, end.close - action.min_duration);
  }
}

Ticks TimeBounds::latest(SnapId step, std::uint32_t timed_done) const {
  const auto& window = windows_[step];
  Ticks result = window.close == kUnbounded ? kNever : window.close.count();
  if (!touched_[step] || task_.snaps[step].kind == SnapKind::kTimedLiteral) return result;
  const auto none = static_cast<std::uint32_t>(task_.timed_steps.size());
  std::uint32_t next = none;
  for (const VariableId variable : task_.reads[step]) next = first_from(timed_[variable], timed_done, next);
  for (const VariableId variable : task_.writes[step]) next = first_from(timed_[variable], timed_done, next);
  if (next < none) result = std::min(result, (task_.timed_steps[next].time - epsilon_).count());
  if (task_.snaps[step].kind != SnapKind::kEnd) return result;
  next = none;
  for (const VariableId variable : task_.invariant_reads[task_.snaps[step].action]) {
    next = first_from(timed_change_[variable], timed_done, next);
  }
  return next < none ? std::min(result, task_.timed_steps[next].time.count()) : result;
}

Ticks TimeBounds::latest_running(SnapId start, std::uint32_t timed_done) const {
  const Ticks result = latest(start, timed_done);  // the end's window is in that of the start
  if (!touched_[start]) return result;
  const auto none = static_cast<std::uint32_t>(task_.timed_steps.size());
  std::uint32_t next = none;
  const ActionId action = task_.snaps[start].action;
  for (const FactId invariant : task_.invariants[action]) {
    next = first_from(timed_change_[task_.variable(invariant)], timed_done, next);
  }
  if (next == none) return result;
  return std::min(result, (task_.timed_steps[next].time - task_.actions[action].min_duration).count());
}

}  // namespace roci::planner::temporal_pddl
