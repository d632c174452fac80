#include "planner_svc/temporal_pddl/constraints/step_deadlines.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::constraints {

using task::Action, task::ActionId, task::FactId, task::Snap, task::SnapId, task::SnapKind, task::Task,
    task::TimedStep, task::VariableId;
using temporal::Duration, temporal::no_bound;

namespace {

std::uint32_t first_from(const std::vector<std::uint32_t>& steps, std::uint32_t from,
                         std::uint32_t otherwise) {
  const auto found = std::ranges::lower_bound(steps, from);
  return found == steps.end() ? otherwise : std::min(*found, otherwise);
}

}  // namespace

StepDeadlines::StepDeadlines(const Task& task, Duration epsilon)
    : task_(task),
      epsilon_(epsilon),
      timed_(task.variables()),
      timed_change_(task.variables()),
      touched_(task.snaps.size(), false) {
  for (std::uint32_t i = 0; i < task.timed_steps.size(); ++i) {
    const TimedStep& timed = task.timed_steps[i];
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
  }
}

Duration StepDeadlines::time_of(std::uint32_t timed_step) const { return task_.timed_steps[timed_step].time; }

Duration StepDeadlines::latest(SnapId step, std::uint32_t timed_done) const {
  const Snap& snap = task_.snaps[step];
  if (!touched_[step] || snap.kind == SnapKind::timed_literal) return no_bound;
  const auto none = static_cast<std::uint32_t>(task_.timed_steps.size());
  std::uint32_t touching = none;
  for (const VariableId variable : task_.reads[step])
    touching = first_from(timed_[variable], timed_done, touching);
  for (const VariableId variable : task_.writes[step])
    touching = first_from(timed_[variable], timed_done, touching);
  const Duration result = touching < none ? time_of(touching) - epsilon_ : no_bound;
  if (snap.kind != SnapKind::end) return result;
  std::uint32_t breaking = none;
  for (const VariableId variable : task_.invariant_reads[snap.action]) {
    breaking = first_from(timed_change_[variable], timed_done, breaking);
  }
  return breaking < none ? std::min(result, time_of(breaking)) : result;
}

Duration StepDeadlines::latest_running(SnapId start, std::uint32_t timed_done) const {
  const Duration result = latest(start, timed_done);
  if (!touched_[start]) return result;
  const auto none = static_cast<std::uint32_t>(task_.timed_steps.size());
  std::uint32_t breaking = none;
  const ActionId action = task_.snaps[start].action;
  for (const FactId invariant : task_.invariants[action]) {
    breaking = first_from(timed_change_[task_.variable(invariant)], timed_done, breaking);
  }
  if (breaking == none) return result;
  return std::min(result, time_of(breaking) - task_.actions[action].min_duration);
}

}  // namespace roci::planner::temporal_pddl::constraints
