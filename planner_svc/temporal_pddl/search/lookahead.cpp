#include "planner_svc/temporal_pddl/search/lookahead.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

bool Lookahead::follow(const PlanPrefix& from, std::span<const SnapId> relaxed_plan, Successor& last) {
  prefix_ = from;
  failures_left_ = relaxed_plan.size();
  starts_.clear();
  waiting_.clear();
  for (const SnapId snap : relaxed_plan) (waits(snap) ? waiting_ : starts_).push_back(snap);
  while (take_starts(last) || take_one_that_waits(last)) {
  }
  return prefix_.node != from.node;
}

bool Lookahead::waits(SnapId snap) const {
  const SnapKind kind = task_.snaps[snap].kind;
  return kind == SnapKind::end || kind == SnapKind::timed_literal;
}

bool Lookahead::take_starts(Successor& last) {
  return std::erase_if(starts_, [&](SnapId snap) { return take(snap, last); }) > 0;
}

bool Lookahead::take_one_that_waits(Successor& last) {
  const auto taken = std::ranges::find_if(waiting_, [&](SnapId snap) { return take(snap, last); });
  if (taken == waiting_.end()) return false;
  waiting_.erase(taken);
  return true;
}

bool Lookahead::take(SnapId snap, Successor& last) {
  if (prefix_.steps.size() + 2 > kMaxSteps) return false;
  if (failures_left_ == 0 || !space_.possible(prefix_, snap)) return false;
  if (space_.build(prefix_, snap, next_) != Rejection::none) {
    --failures_left_;
    return false;
  }
  space_.add(prefix_.node, next_);
  prefix_ = next_.prefix;
  std::swap(last, next_);
  return true;
}

}  // namespace roci::planner::temporal_pddl
