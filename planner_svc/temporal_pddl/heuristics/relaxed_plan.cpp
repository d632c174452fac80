#include "planner_svc/temporal_pddl/heuristics/relaxed_plan.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::temporal_pddl::heuristics {

using task::Action, task::FactId, task::Goal, task::Snap, task::SnapId, task::SnapKind, task::StateView,
    task::Task;

namespace {

constexpr std::int64_t kMostRepeats = 4000;  // in all
constexpr int kMostTurns = 4;                // of a comparison, where numbers hang on each other in circles

}  // namespace

RelaxedPlan::RelaxedPlan(const Task& task, const RelaxedTask& relaxed, const NumericRelaxation& numbers,
                         BestSupporters& supporters)
    : task_(task),
      relaxed_(relaxed),
      numbers_(numbers),
      supporters_(supporters),
      repeats_(relaxed.operators(), 0),
      passes_(relaxed.propositions(), false),
      is_needed_(relaxed.propositions(), false),
      given_(relaxed.propositions(), false),
      supports_(relaxed.propositions()),
      balances_(numbers.comparisons()),
      changes_(numbers.forms(), 0) {
  for (const Action& action : task.actions) {
    if (action.instantaneous()) continue;
    for (const FactId fact : task.adds[action.start]) {
      if (std::ranges::count(task.deletes[action.end], fact) > 0) passes_[relaxed.proposition(fact)] = true;
    }
  }
}

void RelaxedPlan::begin(StateView state, const EarliestTimes* times) {
  state_ = state;
  times_ = times;
  for (const SnapId op : plan_) repeats_[op] = 0;
  for (const PropositionId proposition : needed_) {
    is_needed_[proposition] = false;
    supports_[proposition] = SnapId();
  }
  for (const PropositionId proposition : given_now_) given_[proposition] = false;
  for (const ComparisonId comparison : asked_) balances_[comparison] = {};
  for (const FormId form : changed_) changes_[form] = 0;
  plan_.clear();
  needed_.clear();
  to_support_.clear();
  to_share_.clear();
  to_choose_.clear();
  careful_ = false;
  given_now_.clear();
  asked_.clear();
  changed_.clear();
  to_settle_.clear();
  repeats_left_ = kMostRepeats;
}

void RelaxedPlan::need(const Goal& goal) {
  for (const FactId fact : goal.facts) need(relaxed_.proposition(fact));
  for (const ComparisonId comparison : numbers_.needs(goal)) need_at_end(comparison);
}

void RelaxedPlan::need(PropositionId proposition) {
  if (is_needed_[proposition]) return;
  is_needed_[proposition] = true;
  needed_.push_back(proposition);
  to_support_.push_back(proposition);
}

void RelaxedPlan::need_before(SnapId op, ComparisonId comparison) {
  const bool first = !balances_[comparison].needed;
  Balance& balance = ask(comparison);
  // Of all operators that need it and take of it, one comes last, and what that one takes need not be left.
  const double own = numbers_.whole_change(op, numbers_.form(comparison), state_);
  if (!balance.needed_at_end) balance.least = first ? own : std::min(balance.least, own);
  queue(comparison);
}

void RelaxedPlan::need_at_end(ComparisonId comparison) {
  Balance& balance = ask(comparison);
  balance.least = 0;
  balance.needed_at_end = true;
  queue(comparison);
}

void RelaxedPlan::include(SnapId op) {
  if (repeats_[op] > 0) return;
  plan_.push_back(op);
  apply(op, 1);
  give(op);
  for (const PropositionId needed : relaxed_.needs(op)) need(needed);
  for (const ComparisonId comparison : numbers_.needs(op)) need_before(op, comparison);
  const Snap& snap = task_.snaps[op];
  if (snap.kind != SnapKind::start) return;
  const SnapId end = task_.actions[snap.action].end;
  if (supporters_.reaches(end)) include(end);
}

void RelaxedPlan::complete() {
  for (;;) {
    support_facts();
    if (to_settle_.empty()) return;
    std::ranges::pop_heap(to_settle_);
    const ComparisonId comparison = to_settle_.back().second;
    to_settle_.pop_back();
    balances_[comparison].queued = false;
    settle(comparison);
  }
}

SnapId RelaxedPlan::supporter(PropositionId proposition) {
  const SnapId fewest = supporters_.supporter(proposition);
  if (!times_ || fewest.is_none()) return fewest;
  const SnapId soonest = times_->supporter(proposition);
  return !soonest.is_none() && supporters_.reaches(soonest) ? soonest : fewest;  // numbers know no times
}

void RelaxedPlan::complete_with_care() {
  careful_ = true;
  complete();
}

// What several envelopes would hold as cheaply waits until it is known which of them are needed anyway; and
// where care is taken, any choice until it is known what must not be undone.
void RelaxedPlan::support_facts() {
  while (!to_support_.empty() || !to_share_.empty() || !to_choose_.empty()) {
    const bool shared = to_support_.empty() && !to_share_.empty();
    const bool chosen = to_support_.empty() && !shared;
    std::vector<PropositionId>& list = chosen ? to_choose_ : shared ? to_share_ : to_support_;
    const PropositionId supported = list.back();
    list.pop_back();
    const SnapId supporter = this->supporter(supported);
    if (supporter.is_none() || (shared && given_[supported])) continue;
    if (chosen) {
      support(supported, least_harmful(supported));
    } else if (!shared && passes_[supported] && supporters_.tied(supported)) {
      to_share_.push_back(supported);
    } else if (!shared && careful_ && harm(supporter) > 0) {
      to_choose_.push_back(supported);
    } else {
      support(supported, supporter);
    }
  }
}

void RelaxedPlan::support(PropositionId proposition, SnapId supporter) {
  supports_[proposition] = supporter;
  include(supporter);
}

SnapId RelaxedPlan::least_harmful(PropositionId proposition) {
  SnapId best = supporter(proposition);
  std::size_t least = harm(best);
  const BucketQueue::Cost cost = supporters_.cost(best);
  supporters_.reach_all(cost);
  for (const SnapId op : relaxed_.added_by(proposition)) {
    if (least == 0) break;
    if (!supporters_.happens(op) || supporters_.cost(op) > cost) continue;
    const std::size_t own = harm(op);
    if (own >= least) continue;
    best = op;
    least = own;
  }
  return best;
}

// Returns how many facts that the plan needs and that hold already its action undoes.
std::size_t RelaxedPlan::harm(SnapId op) const {
  const auto of = [&](SnapId step) {
    return static_cast<std::size_t>(std::ranges::count_if(task_.deletes[step], [&](FactId fact) {
      const PropositionId proposition = relaxed_.proposition(fact);
      return is_needed_[proposition] && supporters_.supporter(proposition).is_none();
    }));
  };
  const SnapId other = task_.other_end(op);
  return of(op) + (other.is_none() ? 0 : of(other));
}

// Notes what passes and is added at no more cost than others would.
void RelaxedPlan::give(SnapId op) {
  for (const PropositionId added : relaxed_.adds(op)) {
    if (!passes_[added] || given_[added] || supporters_.cost(added) < supporters_.cost(op)) continue;
    given_[added] = true;
    given_now_.push_back(added);
  }
}

void RelaxedPlan::queue(ComparisonId comparison) {
  Balance& balance = balances_[comparison];
  if (balance.queued || balance.turns == kMostTurns) return;
  ++balance.turns;
  balance.queued = true;
  to_settle_.emplace_back(supporters_.cost(supporters_.proposition(comparison)), comparison);
  std::ranges::push_heap(to_settle_);
}

void RelaxedPlan::settle(ComparisonId comparison) {
  const SnapId supporter = supporters_.supporter(supporters_.proposition(comparison));
  if (!supporter.is_none()) bring_in(supporter);
  const Balance& balance = balances_[comparison];
  const auto surplus = [&] {
    return numbers_.value(comparison, state_) + changes_[numbers_.form(comparison)] - balance.least;
  };
  const auto gain = [&](SnapId op) { return numbers_.whole_change(op, numbers_.form(comparison), state_); };
  if (numbers_.satisfies(comparison, surplus())) return;
  const bool repeatable = !supporter.is_none() && gain(supporter) > 0;
  const SnapId producer = repeatable ? supporter : supporters_.producer(comparison);
  if (producer.is_none()) return;
  bring_in(producer);
  const double times = std::ceil(-surplus() / gain(producer) - 1e-9);
  if (times >= 1) repeat(producer, static_cast<std::int64_t>(std::min(times, 1e6)));
}

// Takes the operator into the plan with what belongs to it.
void RelaxedPlan::bring_in(SnapId op) {
  include(op);
  support_facts();
}

void RelaxedPlan::repeat(SnapId op, std::int64_t times) {
  times = std::min(times, repeats_left_);
  repeats_left_ -= times;
  const SnapId other = task_.other_end(op);
  apply(op, times);
  if (other.is_none() || !supporters_.reaches(other)) return;
  include(other);  // as that of what runs at first is not in the plan yet
  apply(other, repeats_[op] - repeats_[other]);
}

void RelaxedPlan::apply(SnapId op, std::int64_t times) {
  repeats_[op] += times;
  for (const FormId form : numbers_.touches(op)) {
    const double change = numbers_.change(op, form, state_);
    changes_[form] += static_cast<double>(times) * change;
    changed_.push_back(form);
    if (!(change < 0)) continue;
    for (const ComparisonId comparison : asked_)
      if (numbers_.form(comparison) == form) queue(comparison);
  }
}

RelaxedPlan::Balance& RelaxedPlan::ask(ComparisonId comparison) {
  Balance& balance = balances_[comparison];
  if (!balance.needed) asked_.push_back(comparison);
  balance.needed = true;
  return balance;
}

}  // namespace roci::planner::temporal_pddl::heuristics
