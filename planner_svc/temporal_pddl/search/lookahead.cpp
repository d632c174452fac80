#include "planner_svc/temporal_pddl/search/lookahead.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::search {

using task::Action, task::FactId, task::SnapId, task::SnapKind, task::StateView;

namespace {

constexpr int kMostTimedSteps = 4;  // that are taken for the sake of one start

}  // namespace

bool Lookahead::follow(const PlanPrefix& from, std::span<const SnapId> relaxed_plan, bool careful,
                       Successor& last) {
  careful_ = careful;
  last.prefix = from;
  const StateView state = space_.store().state(from.node);
  last.state.assign(state.begin(), state.end());
  failures_left_ = relaxed_plan.size();
  starts_.clear();
  waiting_.clear();
  for (const SnapId snap : relaxed_plan) (waits(snap) ? waiting_ : starts_).push_back(snap);
  std::ranges::fill(uses_, 0);
  for (const SnapId start : starts_) count_uses(start, 1);
  while (take_starts(last) || take_one_harmful_start(last) || take_one_that_waits(last) ||
         take_start_after_timed_steps(last)) {
  }
  return last.prefix.node != from.node;
}

bool Lookahead::waits(SnapId snap) const {
  const SnapKind kind = task_.snaps[snap].kind;
  return kind == SnapKind::end || kind == SnapKind::timed_literal;
}

bool Lookahead::take_starts(Successor& last) {
  return std::erase_if(starts_, [&](SnapId start) {
           return !has_to_wait(start, last.prefix) && take_start(start, last);
         }) > 0;
}

bool Lookahead::take_one_harmful_start(Successor& last) {
  const auto taken = std::ranges::find_if(
      starts_, [&](SnapId start) { return has_to_wait(start, last.prefix) && take_start(start, last); });
  if (taken == starts_.end()) return false;
  starts_.erase(taken);
  return true;
}

bool Lookahead::take_one_that_waits(Successor& last) {
  const auto taken = std::ranges::find_if(waiting_, [&](SnapId snap) { return take(snap, last); });
  if (taken == waiting_.end()) return false;
  waiting_.erase(taken);
  return true;
}

bool Lookahead::take_start_after_timed_steps(Successor& last) {
  if (starts_.empty() || last.prefix.timed_done == task_.timed_steps.size()) return false;
  before_timed_ = last;
  for (int i = 0; i < kMostTimedSteps && last.prefix.timed_done < task_.timed_steps.size(); ++i) {
    failures_left_ = starts_.size() + 1;
    if (!take(task_.timed_steps[last.prefix.timed_done].snap, last)) break;
    if (take_starts(last) || take_one_harmful_start(last)) return true;
  }
  last = before_timed_;
  return false;
}

bool Lookahead::take_start(SnapId start, Successor& last) {
  if (!take(start, last)) return false;
  count_uses(start, -1);
  return true;
}

bool Lookahead::has_to_wait(SnapId start, const PlanPrefix& prefix) const {
  if (!careful_) return false;
  const Action& action = action_of(start);
  const StateView state = space_.store().state(prefix.node);
  const auto harmed = [&](FactId fact) {
    return uses_[fact] > 0 && task_.layout.holds(state, fact) && undoes(task_, action, fact);
  };
  return std::ranges::any_of(task_.deletes[action.start], harmed) ||
         std::ranges::any_of(task_.deletes[action.end], harmed);
}

void Lookahead::count_uses(SnapId start, int by) {
  const Action& action = action_of(start);
  const auto count = [&](FactId fact) {
    if (!undoes(task_, action, fact)) uses_[fact] += by;
  };
  std::ranges::for_each(task_.conditions[start], count);
  std::ranges::for_each(task_.invariants[task_.snaps[start].action], count);
}

bool Lookahead::take(SnapId snap, Successor& last) {
  if (failures_left_ == 0 || !space_.possible(last.prefix, snap)) return false;
  const auto advance = space_.advance(snap, last);
  if (advance == StateSpace::Advance::rejected) --failures_left_;
  return advance == StateSpace::Advance::done;
}

}  // namespace roci::planner::temporal_pddl::search
