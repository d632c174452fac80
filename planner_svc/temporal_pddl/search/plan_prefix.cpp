#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using constraints::BoundTable;
using task::ActionId, task::SnapId, task::SnapKind, task::Task;
using temporal::Duration, temporal::no_bound;

void rebuild(const Task& task, const StateStore& store, const BoundTable& bounds, Duration epsilon,
             NodeId node, PlanPrefix& prefix) {
  prefix.node = node;
  prefix.steps.clear();
  prefix.start_of.clear();
  prefix.constraints.clear();
  prefix.running.clear();
  prefix.running_actions.clear();
  prefix.deadline = no_bound;
  prefix.closing_time = Duration{0};
  prefix.closing_step = 0;
  prefix.timed_done = 0;
  std::vector<NodeId> path;
  for (NodeId n = node; !store.parent(n).is_none(); n = store.parent(n)) path.push_back(n);
  for (auto n = path.rbegin(); n != path.rend(); ++n) {
    const Transition transition = store.transition(*n);
    const NodeId before = store.parent(*n);
    append_step(task, transition.snap, before, prefix);
    if (transition.compressed)
      append_step(task, task.actions[task.snaps[transition.snap].action].end, before, prefix);
    decode(store.code(*n), epsilon, bounds, prefix.constraints);
  }
}

void append_step(const Task& task, SnapId snap, NodeId before, PlanPrefix& prefix) {
  const auto step = static_cast<std::uint32_t>(prefix.steps.size());
  const ActionId action = task.snaps[snap].action;
  prefix.steps.push_back(snap);
  prefix.start_of.push_back(step);
  switch (task.snaps[snap].kind) {
    case SnapKind::start:
      prefix.running.push_back({action, step, before});
      prefix.running_actions.push_back(action);
      break;
    case SnapKind::end: {
      const auto place = std::ranges::find(prefix.running_actions, action) - prefix.running_actions.begin();
      prefix.start_of.back() = prefix.running[static_cast<std::size_t>(place)].step;
      prefix.running.erase(prefix.running.begin() + place);
      prefix.running_actions.erase(prefix.running_actions.begin() + place);
      break;
    }
    case SnapKind::timed_literal:
      ++prefix.timed_done;
      break;
    case SnapKind::instant:
    case SnapKind::derivation:
      break;
  }
}

}  // namespace roci::planner::temporal_pddl::search
