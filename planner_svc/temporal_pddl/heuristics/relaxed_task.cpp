#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using task::ActionId, task::FactId, task::NumbersView, task::NumericEffect, task::Semantics, task::Snap,
    task::SnapId, task::SnapKind, task::Task;

namespace {

// Durations that depend on the state are taken as they are at first.
std::int64_t least_duration(const Task& task, const Semantics& semantics, ActionId action) {
  const auto bounds = semantics.duration(action, task.initial_state, std::nullopt);
  return std::max<std::int64_t>(0, (bounds ? bounds->min : task.actions[action].min_duration).count());
}

// Returns what the snap action adds to the metric if it is taken at first.
std::int64_t metric_cost(const Task& task, const Semantics& semantics, SnapId op, std::int64_t duration) {
  double millionths = task.metric.expression.duration_weight * static_cast<double>(duration);
  const Snap& snap = task.snaps[op];
  const bool timed = snap.kind == SnapKind::start || snap.kind == SnapKind::end;
  const auto bounds =
      timed ? semantics.duration(snap.action, task.initial_state, std::nullopt) : std::nullopt;
  const NumbersView numbers = task.layout.numbers(task.initial_state);
  for (const NumericEffect& effect : task.numeric_effects[op]) {
    const double value = evaluate(task.expressions[effect.expression], numbers, bounds ? bounds->seconds : 0);
    const double change = effect.assigns ? value - numbers[effect.variable] : value;
    for (const auto& term : task.metric.expression.terms) {
      if (term.variable == effect.variable) millionths += 1e6 * term.weight * change;
    }
  }
  return std::isfinite(millionths) ? std::llround(std::clamp(millionths, 0.0, 1e15)) : 0;
}

}  // namespace

RelaxedTask::RelaxedTask(const Task& task, CostMeasure measure)
    : facts_(task.fact_names.size()), running_(task.actions.size()) {
  const Semantics semantics(task);
  std::vector<std::vector<SnapId>> needed_by(propositions()), added_by(propositions());
  for (std::size_t i = 0; i < task.snaps.size(); ++i) {
    const SnapId op(i);
    const Snap& snap = task.snaps[op];
    std::vector<PropositionId> needs, adds;
    for (const FactId fact : task.conditions[op]) needs.push_back(proposition(fact));
    for (const FactId fact : task.adds[op]) adds.push_back(proposition(fact));
    if (snap.kind == SnapKind::start) {
      for (const FactId fact : task.invariants[snap.action]) {
        if (!task.is_derived[fact] && std::ranges::count(task.adds[op], fact) == 0)
          needs.push_back(proposition(fact));
      }
      adds.push_back(running(snap.action));
    }
    if (snap.kind == SnapKind::end) {
      needs.push_back(running(snap.action));
      for (const FactId fact : task.invariants[snap.action]) {  // which the start may have brought about
        if (task.is_derived[fact]) needs.push_back(proposition(fact));
      }
    }
    std::ranges::sort(needs);
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    for (const PropositionId need : needs) needed_by[need.index()].push_back(op);
    for (const PropositionId added : adds) added_by[added.index()].push_back(op);
    if (needs.empty() && snap.kind != SnapKind::timed_literal) free_.push_back(op);
    const std::int64_t duration =
        snap.kind == SnapKind::start ? least_duration(task, semantics, snap.action) : 0;
    costs_.push_back(measure == CostMeasure::metric ? metric_cost(task, semantics, op, duration) : duration);
    is_choice_.push_back(snap.kind == SnapKind::start || snap.kind == SnapKind::instant);
    lists_.push_back(needs);
    lists_.push_back(adds);
  }
  for (const auto& list : needed_by) needed_by_.push_back(list);
  for (const auto& list : added_by) added_by_.push_back(list);
}

}  // namespace roci::planner::temporal_pddl::heuristics
