#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

#include <algorithm>
#include <vector>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl {

namespace {

// Durations that depend on the state are taken as they are at first.
std::int64_t least_duration(const Task& task, const Semantics& semantics, ActionId action) {
  const auto bounds = semantics.duration(action, task.initial_state, std::nullopt);
  return std::max<std::int64_t>(0, (bounds ? bounds->min : task.actions[action].min_duration).count());
}

}  // namespace

RelaxedTask::RelaxedTask(const Task& task) : facts_(task.fact_names.size()), running_(task.actions.size()) {
  const Semantics semantics(task);
  std::vector<std::vector<SnapId>> needed_by(propositions());
  for (std::size_t i = 0; i < task.snaps.size(); ++i) {
    const SnapId op(i);
    const Snap& snap = task.snaps[op];
    std::vector<PropositionId> needs, adds;
    for (const FactId fact : task.conditions[op]) needs.push_back(proposition(fact));
    for (const FactId fact : task.adds[op]) adds.push_back(proposition(fact));
    if (snap.kind == SnapKind::start) {
      for (const FactId fact : task.invariants[snap.action]) {
        if (!task.is_derived[fact] && std::ranges::count(task.adds[op], fact) == 0)
          needs.push_back(proposition(fact));
      }
      adds.push_back(running(snap.action));
    }
    if (snap.kind == SnapKind::end) {
      needs.push_back(running(snap.action));
      for (const FactId fact : task.invariants[snap.action]) {  // which the start may have brought about
        if (task.is_derived[fact]) needs.push_back(proposition(fact));
      }
    }
    std::ranges::sort(needs);
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    for (const PropositionId need : needs) needed_by[need.index()].push_back(op);
    if (needs.empty() && snap.kind != SnapKind::timed_literal) free_.push_back(op);
    costs_.push_back(snap.kind == SnapKind::start ? least_duration(task, semantics, snap.action) : 0);
    needs_.push_back(needs);
    adds_.push_back(adds);
  }
  for (const auto& list : needed_by) needed_by_.push_back(list);
}

}  // namespace roci::planner::temporal_pddl
