#include "planner_svc/temporal_pddl/improvement/plan_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::improvement {

using search::PlanPrefix, search::TemporalCheck;
using task::DurationBounds, task::LinearExpression, task::NumericEffect, task::Semantics, task::Snap,
    task::SnapId, task::SnapKind, task::StateView, task::Task, task::Word;
using temporal::Duration;

namespace {

// Returns the state after the last step.
std::vector<Word> final_state(const Task& task, const PlanPrefix& plan) {
  const Semantics semantics(task);
  std::vector<Word> state = task.initial_state;
  std::vector<std::vector<Word>> before(plan.steps.size());  // the starts of durative actions
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const Snap& snap = task.snaps[plan.steps[i]];
    std::optional<DurationBounds> bounds;
    if (snap.kind == SnapKind::start) {
      before[i] = state;
      bounds = semantics.duration(snap.action, state, std::nullopt);
    } else if (snap.kind == SnapKind::end) {
      bounds = semantics.duration(snap.action, before[plan.start_of[i]], StateView(state));
    }
    semantics.apply(plan.steps[i], bounds ? bounds->seconds : 0, state);
  }
  return state;
}

// Returns the metric that is minimized.
double cost_of(const Task& task, const PlanPrefix& plan, Duration makespan) {
  const LinearExpression& metric = task.metric.expression;
  const bool numbers = !metric.terms.empty();
  const std::vector<Word> state = numbers ? final_state(task, plan) : task.initial_state;
  return evaluate(metric, task.layout.numbers(state), temporal::to_seconds(makespan));
}

bool term_only_grows(const Task& task, SnapId snap, const LinearExpression::Term& term) {
  return std::ranges::all_of(task.numeric_effects[snap], [&](const NumericEffect& effect) {
    if (effect.variable != term.variable) return true;
    const LinearExpression& change = task.expressions[effect.expression];
    return !effect.assigns && change.terms.empty() && term.weight * change.duration_weight >= 0 &&
           term.weight * change.constant >= 0;
  });
}

}  // namespace

PlanQuality quality_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check) {
  const std::vector<Duration>& times = *check.earliest(plan);
  PlanQuality result;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (task.snaps[plan.steps[i]].kind == SnapKind::timed_literal) continue;
    ++result.steps;
    result.makespan = std::max(result.makespan, times[i]);
    result.busy += times[i] - times[plan.start_of[i]];
  }
  constexpr double kWorst = 9e18;
  const double millionths = task.metric.only_time() ? 0 : 1e6 * cost_of(task, plan, result.makespan);
  result.metric = std::isnan(millionths) ? std::numeric_limits<std::int64_t>::max()
                                         : std::llround(std::clamp(millionths, -kWorst, kWorst));
  return result;
}

Duration starts_of(const Task& task, const PlanPrefix& plan, TemporalCheck& check) {
  const std::vector<Duration>& times = *check.earliest(plan);
  Duration result{0};
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const SnapKind kind = task.snaps[plan.steps[i]].kind;
    if (kind == SnapKind::start || kind == SnapKind::instant) result += times[i];
  }
  return result;
}

bool only_grows(const Task& task) {
  const LinearExpression& metric = task.metric.expression;
  return metric.duration_weight >= 0 && std::ranges::all_of(metric.terms, [&](const auto& term) {
           for (std::size_t i = 0; i < task.snaps.size(); ++i) {
             if (!term_only_grows(task, SnapId(i), term)) return false;
           }
           return true;
         });
}

double metric_of(const Task& task, const PlanPrefix& plan, Duration makespan) {
  const double cost = cost_of(task, plan, makespan);
  return task.metric.maximized ? -cost : cost;
}

}  // namespace roci::planner::temporal_pddl::improvement
