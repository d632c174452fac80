#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::search {

using constraints::StepConstraint;
using task::ActionId;
using task::SnapId;

std::span<const SnapId> StateSpace::applicable(const PlanPrefix& prefix) {
  candidates_.clear();
  for (const ActionId action : prefix.running_actions) candidates_.push_back(task_.actions[action].end);
  const std::size_t running = candidates_.size();
  tree_.collect(store_.state(prefix.node), candidates_);
  if (touched_)
    for (const SnapId snap : std::span(candidates_).subspan(running))
      (*touched_)[task_.snaps[snap].action.index()] = true;
  if (prefix.timed_done < task_.timed_steps.size())
    candidates_.push_back(task_.timed_steps[prefix.timed_done].snap);
  std::erase_if(candidates_, [&](SnapId snap) { return !builder_.applicable(prefix, snap); });
  return candidates_;
}

StateSpace::Advance StateSpace::advance(SnapId snap, Successor& plan) {
  if (builder_.advance(snap, plan) != Rejection::none) return Advance::rejected;
  if (is_too_long(plan.prefix)) {
    builder_.take_back(plan);
    return Advance::too_long;
  }
  add(plan.prefix.node, plan);
  return Advance::done;
}

NodeId StateSpace::add(NodeId parent, Successor& successor) {
  code_.clear();
  const auto fresh = std::span(successor.prefix.constraints).last(successor.new_constraints);
  for (const StepConstraint& constraint : fresh) encode(constraint, epsilon_, bounds_, code_);
  successor.prefix.node = store_.add(successor.state, parent, successor.transition, code_);
  return successor.prefix.node;
}

}  // namespace roci::planner::temporal_pddl::search
