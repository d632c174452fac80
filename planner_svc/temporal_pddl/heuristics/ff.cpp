#include "planner_svc/temporal_pddl/heuristics/ff.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

FfHeuristic::FfHeuristic(const Task& task, CostMeasure measure)
    : task_(task),
      relaxed_(task, measure),
      numbers_(task),
      earliest_(task, relaxed_),
      reached_at_(relaxed_.propositions() + numbers_.comparisons(), kUnreached),
      supporter_(reached_at_.size()),
      needed_(reached_at_.size(), false),
      repeats_(numbers_.comparisons(), 1),
      at_first_(relaxed_.operators()),
      in_plan_(relaxed_.operators(), false),
      times_(relaxed_.operators(), 1) {
  for (std::size_t i = 0; i < relaxed_.operators(); ++i) {
    const SnapKind kind = task.snaps[SnapId(i)].kind;
    at_first_[SnapId(i)] = {
        kind == SnapKind::start || kind == SnapKind::instant ? 1 : 0,
        static_cast<std::uint32_t>(relaxed_.needs(SnapId(i)).size() + numbers_.needs(SnapId(i)).size())};
  }
}

void FfHeuristic::evaluate(const Situation& situation, Estimate& estimate) {
  const auto& running = situation.running;
  estimate = {};
  reset();
  if (earliest_.matters()) earliest_.measure(situation);
  explore(situation);
  const Goal* goal = cheapest_goal();
  const bool ends_reached =
      std::ranges::all_of(running, [&](ActionId action) { return possible(task_.actions[action].end); });
  if (!goal || !ends_reached) {
    estimate.dead_end = true;
    return;
  }
  for (const FactId fact : goal->facts) need(relaxed_.proposition(fact));
  for (const ComparisonId comparison : numbers_.needs(*goal)) need(proposition(comparison));
  for (const ActionId action : running) include(task_.actions[action].end);
  extract();
  collect(situation.timed_done, estimate);
}

std::string FfHeuristic::why_too_late() {
  if (!earliest_.matters()) return {};
  earliest_.measure({task_.initial_state, {}, 0, nullptr, {}, {}});
  std::string reason;
  for (const Goal& goal : task_.goals) {
    const auto never = std::ranges::find_if(
        goal.facts, [&](FactId fact) { return earliest_.of(relaxed_.proposition(fact)) == kNever; });
    if (never == goal.facts.end()) return {};
    const std::string why = earliest_.why_never(relaxed_.proposition(*never));
    if (why.empty()) return {};
    reason = name(task_, *never) + " cannot be reached in time: " + why;
  }
  return reason;
}

void FfHeuristic::reset() {
  std::ranges::fill(reached_at_, kUnreached);
  std::ranges::fill(supporter_, SnapId());
  needed_.assign(needed_.size(), false);
  operators_ = at_first_;
  in_plan_.assign(in_plan_.size(), false);
  times_.assign(times_.size(), 1);
  queue_.restart();
  to_support_.clear();
  plan_.clear();
}

bool FfHeuristic::reach(PropositionId proposition, std::int64_t cost, SnapId supporter) {
  std::int64_t& known = reached_at_[proposition];
  if (known != kUnreached && known <= cost) return false;
  known = cost;
  supporter_[proposition] = supporter;
  queue_.push(cost, proposition);
  return true;
}

void FfHeuristic::explore(const Situation& situation) {
  relaxed_.each_fact(task_, situation.state,
                     [&](FactId fact) { reach(relaxed_.proposition(fact), 0, SnapId()); });
  for (const ActionId action : situation.running) reach(relaxed_.running(action), 0, SnapId());
  for (std::size_t i = 0; i < numbers_.comparisons(); ++i) {
    if (numbers_.holds(ComparisonId(i), situation.state)) reach(proposition(ComparisonId(i)), 0, SnapId());
  }
  for (std::size_t i = situation.timed_done; i < task_.timed_steps.size(); ++i)
    fire(task_.timed_steps[i].snap, situation.state);
  for (const SnapId op : relaxed_.free()) fire(op, situation.state);
  while (!queue_.empty()) {
    const auto [cost, proposition] = queue_.pop();
    if (cost > reached_at_[proposition]) continue;
    for (const SnapId op : needed_by(proposition)) {
      Operator& state = operators_[op];
      state.cost += cost;
      if (--state.open == 0) fire(op, situation.state);
    }
  }
}

std::span<const SnapId> FfHeuristic::needed_by(PropositionId proposition) const {
  const std::size_t facts = relaxed_.propositions();
  return proposition.index() < facts ? relaxed_.needed_by(proposition)
                                     : numbers_.needed_by(ComparisonId(proposition.index() - facts));
}

void FfHeuristic::fire(SnapId op, StateView state) {
  if (!possible(op)) return;
  const std::int64_t cost = operators_[op].cost;
  for (const PropositionId added : relaxed_.adds(op)) reach(added, cost, op);
  for (const Raise& raise : numbers_.raises(op)) {
    const PropositionId raised = proposition(raise.comparison);
    if (reached_at_[raised] != kUnreached && reached_at_[raised] <= cost) continue;
    const std::int64_t repeats = numbers_.repeats(raise, state);
    if (reach(raised, cost + repeats - 1, op)) repeats_[raise.comparison] = repeats;
  }
}

bool FfHeuristic::possible(SnapId op) const {
  return operators_[op].open == 0 && (!earliest_.matters() || earliest_.of(op) != kNever);
}

const Goal* FfHeuristic::cheapest_goal() const {
  const Goal* best = nullptr;
  std::int64_t best_cost = 0;
  for (const Goal& goal : task_.goals) {
    std::int64_t cost = 0;
    bool reached = true;
    for (const FactId fact : goal.facts) {
      const std::int64_t at = reached_at_[relaxed_.proposition(fact)];
      reached = reached && at != kUnreached;
      cost += at;
    }
    for (const ComparisonId comparison : numbers_.needs(goal)) {
      const std::int64_t at = reached_at_[proposition(comparison)];
      reached = reached && at != kUnreached;
      cost += at;
    }
    if (!reached || (best && cost >= best_cost)) continue;
    best = &goal;
    best_cost = cost;
  }
  return best;
}

void FfHeuristic::need(PropositionId proposition) {
  if (needed_[proposition]) return;
  needed_[proposition] = true;
  to_support_.push_back(proposition);
}

void FfHeuristic::include(SnapId op) {
  if (in_plan_[op]) return;
  in_plan_[op] = true;
  plan_.push_back(op);
  for (const PropositionId needed : relaxed_.needs(op)) need(needed);
  for (const ComparisonId comparison : numbers_.needs(op)) need(proposition(comparison));
  const Snap& snap = task_.snaps[op];
  if (snap.kind != SnapKind::start) return;
  const SnapId end = task_.actions[snap.action].end;
  if (possible(end)) include(end);
}

void FfHeuristic::extract() {
  while (!to_support_.empty()) {
    const PropositionId supported = to_support_.back();
    const SnapId supporter = supporter_[supported];
    to_support_.pop_back();
    if (supporter.is_none()) continue;
    include(supporter);
    if (supported.index() >= relaxed_.propositions()) {
      const ComparisonId comparison(supported.index() - relaxed_.propositions());
      times_[supporter] = std::max(times_[supporter], repeats_[comparison]);
    }
  }
}

bool FfHeuristic::holds_now(SnapId op) const {
  return std::ranges::all_of(relaxed_.needs(op),
                             [&](PropositionId need) { return supporter_[need].is_none(); }) &&
         std::ranges::all_of(numbers_.needs(op),
                             [&](ComparisonId need) { return supporter_[proposition(need)].is_none(); });
}

void FfHeuristic::order_plan(std::vector<SnapId>& ordered) const {
  for (const SnapId op : plan_) {
    if (task_.snaps[op].kind != SnapKind::derivation)
      ordered.insert(ordered.end(), static_cast<std::size_t>(times_[op]), op);
  }
  std::ranges::stable_sort(ordered, {}, [&](SnapId op) { return operators_[op].cost; });
}

void FfHeuristic::collect(std::uint32_t timed_done, Estimate& estimate) const {
  bool waits_for_timed = false;
  for (const SnapId op : plan_) {
    const Snap& snap = task_.snaps[op];
    if (snap.kind == SnapKind::derivation) continue;
    estimate.cost += times_[op] * relaxed_.cost(op);
    // An end that has to come several times takes as many starts.
    estimate.steps += snap.kind == SnapKind::end ? 2 * times_[op] - 1 : times_[op];
    if (snap.kind == SnapKind::end)
      estimate.cost += (times_[op] - 1) * relaxed_.cost(task_.actions[snap.action].start);
    if (snap.kind == SnapKind::timed_literal) {
      waits_for_timed = true;
      continue;
    }
    if (holds_now(op)) estimate.preferred.push_back(op);
  }
  order_plan(estimate.relaxed_plan);
  if (waits_for_timed) estimate.preferred.push_back(task_.timed_steps[timed_done].snap);
}

}  // namespace roci::planner::temporal_pddl
