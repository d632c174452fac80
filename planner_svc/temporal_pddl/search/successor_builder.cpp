#include "planner_svc/temporal_pddl/search/successor_builder.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl::search {

using constraints::StepConstraint;
using task::Action, task::ActionCompression, task::ActionId, task::FactId, task::Snap, task::SnapId,
    task::SnapKind, task::StateView;
using temporal::Duration, temporal::no_bound;

double SuccessorBuilder::seconds_of(const Running& running) const {
  const auto bounds = semantics_.duration(running.action, store_.state(running.before), std::nullopt);
  return bounds ? bounds->seconds : 0;
}

bool SuccessorBuilder::applicable(const PlanPrefix& prefix, SnapId snap_id) const {
  const Snap& snap = task_.snaps[snap_id];
  const StateView state = store_.state(prefix.node);
  switch (snap.kind) {
    case SnapKind::derivation:
      return false;
    case SnapKind::timed_literal:
      return prefix.timed_done < task_.timed_steps.size() &&
             task_.timed_steps[prefix.timed_done].snap == snap_id;
    case SnapKind::instant:
      return semantics_.applicable(snap_id, state, 0);
    case SnapKind::start: {
      if (std::ranges::count(prefix.running_actions, snap.action) > 0) return false;
      const auto bounds = semantics_.duration(snap.action, state, std::nullopt);
      return bounds && semantics_.applicable(snap_id, state, bounds->seconds);
    }
    case SnapKind::end: {
      const auto running = std::ranges::find(prefix.running, snap.action, &Running::action);
      return running != prefix.running.end() && semantics_.applicable(snap_id, state, seconds_of(*running));
    }
  }
  return false;
}

Rejection SuccessorBuilder::build(const PlanPrefix& prefix, SnapId snap, Successor& successor) {
  if (!extend(prefix, snap, successor)) return Rejection::logical;
  return schedule(prefix.running.empty(), successor);
}

Rejection SuccessorBuilder::schedule(bool idle_before, Successor& successor) {
  if (!absolute_ && idle_before && successor.prefix.running.empty()) {
    successor.times.clear();
    return long_enough(successor) ? Rejection::none : Rejection::temporal;
  }
  const std::vector<Duration>* times = check_.earliest(successor.prefix);
  if (!times) return Rejection::temporal;
  successor.times = *times;
  return Rejection::none;
}

// Returns whether the compressed action's longest duration suffices for what keeps its start and its end
// apart.
bool SuccessorBuilder::long_enough(const Successor& successor) {
  const auto fresh = std::span(successor.prefix.constraints).last(successor.new_constraints);
  Duration least{0}, most = no_bound;
  for (const StepConstraint& constraint : fresh) {
    if (constraint.from + 1 != constraint.to || constraint.to + 1 != successor.prefix.steps.size()) continue;
    least = std::max(least, constraint.lower);
    most = std::min(most, constraint.upper);
  }
  return least <= most;
}

Rejection SuccessorBuilder::advance(SnapId snap, Successor& plan) {
  remember(plan);
  const Rejection rejection =
      append(snap, plan) ? schedule(before_.running.empty(), plan) : Rejection::logical;
  if (rejection != Rejection::none) take_back(plan);
  return rejection;
}

bool SuccessorBuilder::advance_unscheduled(SnapId snap, Successor& plan) {
  remember(plan);
  if (append(snap, plan)) return true;
  take_back(plan);
  return false;
}

void SuccessorBuilder::remember(Successor& plan) {
  before_.transition = plan.transition;
  before_.steps = plan.prefix.steps.size();
  before_.constraints = plan.prefix.constraints.size();
  before_.new_constraints = plan.new_constraints;
  before_.running = plan.prefix.running;
  before_.running_actions = plan.prefix.running_actions;
  before_.timed_done = plan.prefix.timed_done;
  std::swap(before_.times, plan.times);
}

void SuccessorBuilder::take_back(Successor& plan) {
  const StateView state = store_.state(plan.prefix.node);
  plan.state.assign(state.begin(), state.end());
  plan.transition = before_.transition;
  plan.prefix.steps.resize(before_.steps);
  plan.prefix.start_of.resize(before_.steps);
  plan.prefix.constraints.resize(before_.constraints);
  plan.prefix.running = before_.running;
  plan.prefix.running_actions = before_.running_actions;
  plan.prefix.timed_done = before_.timed_done;
  plan.new_constraints = before_.new_constraints;
  std::swap(before_.times, plan.times);
}

bool SuccessorBuilder::extend(const PlanPrefix& prefix, SnapId snap, Successor& successor) {
  const StateView before = store_.state(prefix.node);
  successor.state.assign(before.begin(), before.end());
  successor.prefix = prefix;
  return append(snap, successor);
}

// Takes the snap action, and if it is compressed its end too, after the plan in `successor`.
bool SuccessorBuilder::append(SnapId snap_id, Successor& successor) {
  const Snap& snap = task_.snaps[snap_id];
  const PlanPrefix& prefix = successor.prefix;
  successor.transition = {snap_id, false};
  const std::size_t constraints = prefix.constraints.size();
  bool possible = false;
  switch (snap.kind) {
    case SnapKind::derivation:
      break;
    case SnapKind::timed_literal:
    case SnapKind::instant:
      possible = take(snap_id, 0, successor);
      break;
    case SnapKind::start:
      possible = start(snap.action, prefix.node, successor);
      break;
    case SnapKind::end: {
      const auto running = std::ranges::find(prefix.running, snap.action, &Running::action);
      possible = end(snap.action, store_.state(running->before), successor);
      break;
    }
  }
  successor.new_constraints = prefix.constraints.size() - constraints;
  return possible;
}

// Takes one step: adds its orderings, applies its effects, and returns whether the invariants of what runs
// then hold.
bool SuccessorBuilder::take(SnapId snap, double seconds, Successor& successor) {
  PlanPrefix& prefix = successor.prefix;
  orderings_.add(prefix.steps, snap, prefix.running_actions, prefix.constraints);
  append_step(task_, snap, prefix.node, prefix);
  semantics_.apply(snap, seconds, successor.state);
  return running_invariants_hold(successor);
}

bool SuccessorBuilder::ends_at_once(ActionId id, StateView before) const {
  return task_.actions[id].compression_safe &&
         std::ranges::none_of(task_.absent_for_compression[id],
                              [&](FactId fact) { return task_.layout.holds(before, fact); });
}

bool SuccessorBuilder::start(ActionId id, NodeId before, Successor& successor) {
  const Action& action = task_.actions[id];
  const StateView state = store_.state(before);
  const bool compressed = steps_ == ActionCompression::always || ends_at_once(id, state);
  const auto bounds = semantics_.duration(id, state, std::nullopt);
  if (!bounds || !take(action.start, bounds->seconds, successor)) return false;
  if (!compressed) return true;
  successor.transition.compressed = true;
  return semantics_.applicable(action.end, successor.state, bounds->seconds) && end(id, state, successor);
}

bool SuccessorBuilder::end(ActionId id, StateView before_start, Successor& successor) {
  const auto bounds = semantics_.duration(id, before_start, StateView(successor.state));
  if (!bounds || !take(task_.actions[id].end, bounds->seconds, successor)) return false;
  PlanPrefix& prefix = successor.prefix;
  prefix.constraints.push_back({prefix.start_of.back(), static_cast<std::uint32_t>(prefix.steps.size() - 1),
                                bounds->min, bounds->max});
  return true;
}

bool SuccessorBuilder::running_invariants_hold(const Successor& successor) const {
  return std::ranges::all_of(successor.prefix.running, [&](const Running& running) {
    const bool measured = !task_.numeric_invariants[running.action].empty();
    return semantics_.invariants_hold(running.action, successor.state, measured ? seconds_of(running) : 0);
  });
}

}  // namespace roci::planner::temporal_pddl::search
