#include "planner_svc/temporal_pddl/task/semantics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace roci::planner::temporal_pddl::task {

using temporal::Duration;

bool Semantics::holds_all(std::span<const FactId> facts, StateView state) const {
  return std::ranges::all_of(facts, [&](FactId fact) { return task_.layout.holds(state, fact); });
}

bool Semantics::holds_all(std::span<const NumericCondition> conditions, StateView state,
                          double seconds) const {
  return std::ranges::all_of(conditions, [&](const NumericCondition& condition) {
    return holds(condition.comparator,
                 evaluate(task_.expressions[condition.expression], task_.layout.numbers(state), seconds));
  });
}

bool Semantics::applicable(SnapId snap, StateView state, double seconds) const {
  return holds_all(task_.conditions[snap], state) && holds_all(task_.comparisons[snap], state, seconds);
}

bool Semantics::invariants_hold(ActionId action, StateView state, double seconds) const {
  return holds_all(task_.invariants[action], state) &&
         holds_all(task_.numeric_invariants[action], state, seconds);
}

void Semantics::apply(SnapId snap, double seconds, MutableState state) const {
  const auto effects = task_.numeric_effects[snap];
  std::vector<double> operands;  // before any of them is applied
  for (const NumericEffect& effect : effects) {
    operands.push_back(evaluate(task_.expressions[effect.expression], task_.layout.numbers(state), seconds));
  }
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const double old = task_.layout.numbers(state)[effects[i].variable];
    task_.layout.set_number(state, effects[i].variable, effects[i].assigns ? operands[i] : old + operands[i]);
  }
  for (const FactId fact : task_.deletes[snap]) task_.layout.remove(state, fact);
  for (const FactId fact : task_.adds[snap]) task_.layout.add(state, fact);
  if (!task_.derived.empty()) task_.derived.complete(task_.layout, task_.expressions, state);
}

std::optional<DurationBounds> Semantics::duration(ActionId id, StateView before_start,
                                                  std::optional<StateView> before_end) const {
  const Action& action = task_.actions[id];
  DurationBounds result{action.min_duration, action.max_duration, 0};
  std::optional<double> fixed;
  for (const DurationRule& rule : task_.duration_rules[id]) {
    if (rule.at_end && !before_end) continue;
    const double seconds = evaluate(task_.expressions[rule.bound],
                                    task_.layout.numbers(rule.at_end ? *before_end : before_start), 0);
    if (std::isnan(seconds) || std::abs(seconds) > 1e12) return std::nullopt;
    const Duration bound(std::llround(seconds * 1e6));
    if (rule.from_below) result.min = std::max(result.min, bound);
    if (rule.from_above) result.max = std::min(result.max, bound);
    if (rule.from_below && rule.from_above) fixed = seconds;
  }
  result.seconds = fixed.value_or(std::chrono::duration<double>(result.min).count());
  return result.min <= result.max ? std::optional(result) : std::nullopt;
}

bool Semantics::satisfied(const NumericCondition& condition, StateView state) const {
  return holds_all(std::span(&condition, 1), state, 0);
}

bool Semantics::satisfied(const Goal& goal, StateView state) const {
  return holds_all(goal.facts, state) && holds_all(goal.comparisons, state, 0);
}

bool Semantics::goal_satisfied(StateView state) const {
  return std::ranges::any_of(task_.goals, [&](const Goal& goal) { return satisfied(goal, state); });
}

bool undoes(const Task& task, const Action& action, FactId fact) {
  const auto contains = [&](std::span<const FactId> facts) { return std::ranges::count(facts, fact) > 0; };
  if (contains(task.adds[action.end])) return false;
  return contains(task.deletes[action.end]) ||
         (contains(task.deletes[action.start]) && !contains(task.adds[action.start]));
}

}  // namespace roci::planner::temporal_pddl::task
