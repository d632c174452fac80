#include "planner_svc/temporal_pddl/heuristics/best_supporters.hpp"

#include <algorithm>
#include <limits>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using call::PlanningFailure;
using task::ActionId, task::FactId, task::SnapId, task::Task;
using temporal::Verdict;

BestSupporters::BestSupporters(const Task& task, const RelaxedTask& relaxed, const NumericRelaxation& numbers)
    : task_(task),
      relaxed_(relaxed),
      numbers_(numbers),
      operator_costs_(task, relaxed),
      has_numbers_(numbers.comparisons() > 0),
      reached_(relaxed.propositions() + numbers.comparisons()),
      at_first_(relaxed.operators()),
      repeats_(numbers.comparisons(), 1),
      producers_(numbers.comparisons()) {
  for (std::size_t i = 0; i < relaxed.operators(); ++i) {
    const SnapId op(i);
    const std::size_t needs = relaxed.needs(op).size() + numbers.needs(op).size();
    if (needs > std::numeric_limits<Count>::max())
      throw PlanningFailure(Verdict::unsupported, "an action has more than 65535 ground conditions");
    at_first_[op] = static_cast<Count>(needs);
  }
}

void BestSupporters::begin(const EvaluationContext& context, const EarliestTimes* times) {
  state_ = context.state;
  times_ = times;
  operator_costs_.set(state_);
  std::ranges::fill(reached_, Reached());
  open_ = at_first_;
  std::ranges::fill(producers_, SnapId());
  queue_.restart();
  frontier_ = 0;
  const auto holds = [&](PropositionId proposition) { reach(proposition, 0, SnapId()); };
  RelaxedTask::each_fact(task_, state_, [&](FactId fact) { holds(relaxed_.proposition(fact)); });
  for (const ActionId action : context.running) holds(relaxed_.running(action));
  for (std::size_t i = 0; i < numbers_.comparisons(); ++i) {
    if (numbers_.holds(ComparisonId(i), state_)) holds(proposition(ComparisonId(i)));
  }
  for (std::size_t i = context.timed_done; i < task_.timed_steps.size(); ++i) fire(task_.timed_steps[i].snap);
  for (const SnapId op : relaxed_.free()) {
    if (open_[op] == 0) fire(op);
  }
}

bool BestSupporters::reaches(PropositionId proposition) {
  while (reached_[proposition].cost > frontier_ && advance()) {
  }
  return reached_[proposition].cost != kUnreached;
}

bool BestSupporters::reaches(SnapId op) {
  if (too_late(op)) return false;
  while (open_[op] > 0 && advance()) {
  }
  return open_[op] == 0;
}

SnapId BestSupporters::producer(ComparisonId comparison) {
  while (producers_[comparison].is_none() && advance()) {
  }
  return producers_[comparison];
}

bool BestSupporters::advance() {
  if (queue_.empty()) return false;
  const auto [cost, proposition] = queue_.pop();
  frontier_ = cost;
  if (cost > reached_[proposition].cost) return true;
  for (const SnapId op : needed_by(proposition)) {
    if (--open_[op] == 0) fire(op);
  }
  return true;
}

bool BestSupporters::reach(PropositionId proposition, Cost cost, SnapId supporter) {
  Reached& reached = reached_[proposition];
  if (reached.cost <= cost) {
    reached.tied = reached.tied || reached.cost == cost;
    return false;
  }
  reached = {cost, supporter, false};
  queue_.push(cost, proposition);
  return true;
}

void BestSupporters::fire(SnapId op) {
  if (too_late(op)) return;
  const Cost own = cost(op);
  for (const PropositionId added : relaxed_.adds(op)) reach(added, own, op);
  if (has_numbers_) raise_numbers(op, own);
}

void BestSupporters::raise_numbers(SnapId op, Cost own) {
  for (const ComparisonId comparison : numbers_.raises(op)) {
    const PropositionId raised = proposition(comparison);
    SnapId& producer = producers_[comparison];
    if (producer.is_none() && numbers_.whole_change(op, numbers_.form(comparison), state_) > 0) producer = op;
    if (reached_[raised].cost <= own) continue;
    const std::int64_t repeats = numbers_.repeats(op, comparison, state_);
    const auto repeated = std::min<std::int64_t>(own + repeats - 1, BucketQueue::kMostCost);
    if (reach(raised, static_cast<Cost>(repeated), op)) repeats_[comparison] = repeats;
  }
}

// Adds up its own cost and the costs of its needs, which are all reached.
BestSupporters::Cost BestSupporters::cost(SnapId op) const {
  std::uint64_t sum = operator_costs_.of(op);
  for (const PropositionId need : relaxed_.needs(op)) sum += reached_[need].cost;
  if (has_numbers_) {
    for (const ComparisonId need : numbers_.needs(op)) sum += reached_[proposition(need)].cost;
  }
  return static_cast<Cost>(std::min<std::uint64_t>(sum, BucketQueue::kMostCost));
}

std::span<const SnapId> BestSupporters::needed_by(PropositionId proposition) const {
  const std::size_t facts = relaxed_.propositions();
  return proposition.index() < facts ? relaxed_.needed_by(proposition)
                                     : numbers_.needed_by(ComparisonId(proposition.index() - facts));
}

}  // namespace roci::planner::temporal_pddl::heuristics
