#include "planner_svc/temporal_pddl/heuristics/ff.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace roci::planner::temporal_pddl::heuristics {

using task::ActionId, task::FactId, task::Goal, task::Snap, task::SnapId, task::SnapKind, task::Task;
using temporal::no_bound;

namespace {

constexpr std::int64_t kStepsOfAction = 2;  // its start and its end

}  // namespace

FfHeuristic::FfHeuristic(const Task& task, CostMeasure measure)
    : task_(task),
      relaxed_(task, measure),
      numbers_(task),
      earliest_(task, relaxed_),
      supporters_(task, relaxed_, numbers_),
      plan_(task, relaxed_, numbers_, supporters_) {}

void FfHeuristic::evaluate(const EvaluationContext& context, Estimate& estimate) {
  estimate = {};
  const bool ends_reached = look_at(context);
  const Goal* goal = cheapest_goal();
  if (!goal || !ends_reached) {
    estimate.dead_end = true;
    return;
  }
  plan_.begin(state_, times());
  plan_.need(*goal);
  for (const ActionId action : running_) plan_.include(task_.actions[action].end);
  plan_.complete();
  collect(context.timed_done, estimate);
}

bool FfHeuristic::look_at(const EvaluationContext& context) {
  state_ = context.state;
  running_ = context.running;
  if (times()) earliest_.measure(context);
  supporters_.begin(context, times());
  return std::ranges::all_of(running_,
                             [&](ActionId action) { return supporters_.reaches(task_.actions[action].end); });
}

std::optional<std::int64_t> FfHeuristic::distance(FactId fact) {
  const PropositionId proposition = relaxed_.proposition(fact);
  if (!supporters_.reaches(proposition)) return std::nullopt;
  return supporters_.cost(proposition);
}

void FfHeuristic::plan_for(FactId fact, std::vector<SnapId>& plan) {
  plan.clear();
  listed_.clear();
  plan_.begin(state_, times());
  plan_.need_fact(fact);
  for (const ActionId action : running_) plan_.include(task_.actions[action].end);
  plan_.complete_with_care();
  if (const SnapId last = plan_.support(relaxed_.proposition(fact)); !last.is_none())
    list_deepest_first(last, plan);
  for (const SnapId op : plan_.operators()) list_deepest_first(op, plan);
  if (times()) std::ranges::stable_sort(plan, {}, [&](SnapId op) { return earliest_.of(op); });
}

// A relaxed plan may be one long chain: what is begun stands on a stack of its own.
void FfHeuristic::list_deepest_first(SnapId last, std::vector<SnapId>& ordered) {
  struct Begun {
    SnapId op;
    std::vector<PropositionId> needs;
    std::size_t next = 0;
  };
  std::vector<Begun> begun;
  const auto begin = [&](SnapId op) {
    const auto place = std::ranges::lower_bound(listed_, op);
    if (plan_.times(op) == 0 || (place != listed_.end() && *place == op)) return;
    listed_.insert(place, op);
    std::vector<PropositionId> needs(relaxed_.needs(op).begin(), relaxed_.needs(op).end());
    for (const ComparisonId comparison : numbers_.needs(op))
      needs.push_back(supporters_.proposition(comparison));
    std::ranges::stable_sort(needs, std::greater{},
                             [&](PropositionId need) { return supporters_.cost(need); });
    begun.push_back({op, std::move(needs)});
  };
  begin(last);
  while (!begun.empty()) {
    if (begun.back().next < begun.back().needs.size()) {
      const PropositionId need = begun.back().needs[begun.back().next++];
      const bool fact = need.index() < relaxed_.propositions();
      const SnapId before = fact ? plan_.support(need) : supporters_.supporter(need);
      if (!before.is_none()) begin(before);
      continue;
    }
    const SnapId op = begun.back().op;
    begun.pop_back();
    if (task_.snaps[op].kind != SnapKind::derivation)
      ordered.insert(ordered.end(), static_cast<std::size_t>(plan_.times(op)), op);
  }
}

std::optional<call::BlockedFact> FfHeuristic::lateness() {
  if (!earliest_.matters()) return std::nullopt;
  earliest_.measure({task_.initial_state, {}, 0, nullptr, {}, {}});
  std::optional<call::BlockedFact> late;
  for (const Goal& goal : task_.goals) {
    const auto never = std::ranges::find_if(
        goal.facts, [&](FactId fact) { return earliest_.of(relaxed_.proposition(fact)) == no_bound; });
    if (never == goal.facts.end()) return std::nullopt;
    const std::string why = earliest_.lateness_reason(relaxed_.proposition(*never));
    if (why.empty()) return std::nullopt;
    const std::string fact = name(task_, *never);
    late = {fact, fact + " cannot be reached in time: " + why};
  }
  return late;
}

const Goal* FfHeuristic::cheapest_goal() {
  const Goal* best = nullptr;
  std::int64_t best_cost = 0;
  for (const Goal& goal : task_.goals) {
    std::int64_t cost = 0;
    const auto reached = [&](PropositionId proposition) {
      if (!supporters_.reaches(proposition)) return false;
      cost += supporters_.cost(proposition);
      return true;
    };
    const bool possible =
        std::ranges::all_of(goal.facts, [&](FactId fact) { return reached(relaxed_.proposition(fact)); }) &&
        std::ranges::all_of(numbers_.needs(goal), [&](ComparisonId comparison) {
          return reached(supporters_.proposition(comparison));
        });
    if (!possible || (best && cost >= best_cost)) continue;
    best = &goal;
    best_cost = cost;
  }
  return best;
}

bool FfHeuristic::holds_now(SnapId op) const {
  return std::ranges::all_of(relaxed_.needs(op),
                             [&](PropositionId need) { return supporters_.supporter(need).is_none(); }) &&
         std::ranges::all_of(numbers_.needs(op), [&](ComparisonId need) {
           return supporters_.supporter(supporters_.proposition(need)).is_none();
         });
}

void FfHeuristic::order_plan(std::vector<SnapId>& ordered) const {
  for (const SnapId op : plan_.operators()) {
    if (task_.snaps[op].kind != SnapKind::derivation)
      ordered.insert(ordered.end(), static_cast<std::size_t>(plan_.times(op)), op);
  }
  std::ranges::stable_sort(ordered, {}, [&](SnapId op) { return supporters_.cost(op); });
  if (times()) std::ranges::stable_sort(ordered, {}, [&](SnapId op) { return earliest_.of(op); });
}

void FfHeuristic::collect(std::uint32_t timed_done, Estimate& estimate) const {
  bool waits_for_timed = false;
  for (const SnapId op : plan_.operators()) {
    const Snap& snap = task_.snaps[op];
    if (snap.kind == SnapKind::derivation) continue;
    estimate.cost += plan_.times(op) * relaxed_.cost(op);
    estimate.steps += plan_.times(op) + kStepsOfAction * supporters_.operator_costs().threat_penalty(op);
    if (snap.kind == SnapKind::timed_literal) {
      waits_for_timed = true;
      continue;
    }
    if (holds_now(op)) estimate.preferred.push_back(op);
  }
  order_plan(estimate.relaxed_plan);
  if (waits_for_timed) estimate.preferred.push_back(task_.timed_steps[timed_done].snap);
}

}  // namespace roci::planner::temporal_pddl::heuristics
