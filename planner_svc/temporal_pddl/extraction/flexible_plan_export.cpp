#include "planner_svc/temporal_pddl/extraction/flexible_plan_export.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <variant>

#include "core/pddl/printer.hpp"
#include "planner_svc/engine/function_words.hpp"

namespace roci::planner::temporal_pddl::extraction {

using engine::FunctionOutcome, engine::FunctionUse;
using temporal::Duration;

namespace {

using temporal::Condition;
using temporal::ConditionOp;
using temporal::Duration;

Duration minus(Duration a, Duration b) {
  return temporal::plus(a, b == temporal::no_bound ? -temporal::no_bound : -b);
}

ConditionOp exported(pddl::ComparisonOperator op) {
  switch (op) {
    case pddl::ComparisonOperator::less:
      return ConditionOp::lt;
    case pddl::ComparisonOperator::less_equal:
      return ConditionOp::le;
    case pddl::ComparisonOperator::equal:
      return ConditionOp::eq;
    case pddl::ComparisonOperator::greater_equal:
      return ConditionOp::ge;
    case pddl::ComparisonOperator::greater:
      return ConditionOp::gt;
  }
  return ConditionOp::eq;
}

// A fact and whether it is to be true; nothing for other conditions.
std::optional<pddl::Literal> literal_of(const pddl::Condition& condition) {
  if (const auto* atom = std::get_if<pddl::Atom>(&condition.node)) return pddl::Literal{*atom, false};
  const auto* negation = std::get_if<pddl::Not>(&condition.node);
  if (negation == nullptr) return std::nullopt;
  const auto* atom = std::get_if<pddl::Atom>(&negation->body->node);
  return atom == nullptr ? std::nullopt : std::optional(pddl::Literal{*atom, true});
}

// A fact, or a single fluent beside a number; nothing for what no single timeline decides.
std::optional<Condition> exported(const pddl::Condition& condition) {
  if (const auto literal = literal_of(condition))
    return temporal::compare(pddl::print(literal->atom), ConditionOp::eq, !literal->negated);
  const auto* comparison = std::get_if<pddl::Comparison>(&condition.node);
  if (comparison == nullptr) return std::nullopt;
  const auto* fluent = std::get_if<pddl::Atom>(&comparison->left.node);
  const auto* number = std::get_if<pddl::Number>(&comparison->right.node);
  if (fluent == nullptr || number == nullptr) return std::nullopt;
  return temporal::compare(pddl::print(*fluent), exported(comparison->op), number->value);
}

// A fact that becomes true or false, or a fluent that changes by a number; nothing for other effects.
std::optional<temporal::Impact> exported(const pddl::Effect& effect, temporal::ImpactWhen moment) {
  if (const auto* literal = std::get_if<pddl::Literal>(&effect.node))
    return temporal::Impact{pddl::print(literal->atom), temporal::ImpactKind::assign, moment,
                            !literal->negated};
  const auto* assignment = std::get_if<pddl::Assignment>(&effect.node);
  if (assignment == nullptr) return std::nullopt;
  const auto* number = std::get_if<pddl::Number>(&assignment->value.node);
  const bool less = assignment->op == pddl::AssignmentOperator::decrease;
  if (number == nullptr || (!less && assignment->op != pddl::AssignmentOperator::increase))
    return std::nullopt;
  return temporal::Impact{pddl::print(assignment->fluent), temporal::ImpactKind::delta, moment,
                          less ? -number->value : number->value};
}

bool achieved_by(const pddl::Condition& condition, const std::vector<pddl::Effect>& effects) {
  const auto wanted = literal_of(condition);
  if (!wanted) return false;
  const std::string fact = pddl::print(*wanted);
  return std::ranges::any_of(effects, [&](const pddl::Effect& effect) {
    const auto* literal = std::get_if<pddl::Literal>(&effect.node);
    return literal != nullptr && pddl::print(*literal) == fact;
  });
}

Condition conjunction(const std::vector<Condition>& parts) {
  return parts.empty() ? Condition{} : temporal::all_of(parts);
}

temporal::PlanActivity exported(const Activity& in, std::size_t index,
                                const std::vector<std::string>& goals) {
  temporal::PlanActivity out;
  out.id = "a" + std::to_string(index + 1);
  out.name = in.name;
  for (std::size_t i = 0; i < in.arguments.size(); ++i)
    out.arguments.push_back({std::to_string(i + 1), in.arguments[i]});
  out.duration_lower = in.durative ? in.min_duration : Duration{0};
  out.duration_upper = in.durative ? in.max_duration : Duration{0};
  std::vector<Condition> pre, maintenance;
  for (const pddl::Condition& condition : in.at_start) {
    if (auto part = exported(condition)) pre.push_back(std::move(*part));
  }
  for (const pddl::Condition& condition : in.over_all) {
    auto part = exported(condition);
    if (!part) continue;
    if (!achieved_by(condition, in.start_effects)) pre.push_back(*part);
    maintenance.push_back(std::move(*part));
  }
  for (const pddl::Effect& effect : in.start_effects) {
    if (auto impact = exported(effect, temporal::ImpactWhen::at_start))
      out.impacts.push_back(std::move(*impact));
  }
  for (const pddl::Effect& effect : in.end_effects) {
    if (auto impact = exported(effect, temporal::ImpactWhen::at_end))
      out.impacts.push_back(std::move(*impact));
  }
  for (const std::size_t goal : in.goals_served) out.goals_served.push_back(goals[goal]);
  out.pre = conjunction(pre);
  out.maintenance = conjunction(maintenance);
  return out;
}

// Whether some activity is about all of the function's arguments: only such values can have shaped the plan.
bool concerns(const FunctionUse& use, const Plan& plan) {
  return std::any_of(plan.activities.begin(), plan.activities.end(), [&](const Activity& activity) {
    return std::all_of(use.call.arguments.begin(), use.call.arguments.end(),
                       [&](const std::string& argument) {
                         return std::find(activity.arguments.begin(), activity.arguments.end(), argument) !=
                                activity.arguments.end();
                       });
  });
}

// The engine's time points renumbered: the origin and timed literals are time point 0, the latter with an
// offset.
struct Renumbered {
  temporal::TimePoint point = 0;
  Duration offset{0};
};

}  // namespace

temporal::FlexiblePlan export_plan(const Plan& plan, const std::vector<FunctionUse>& functions,
                                   const std::vector<std::string>& goals) {
  temporal::FlexiblePlan out;
  out.engine = "temporal_pddl";
  std::vector<Renumbered> renumbered(plan.network.points.size());
  for (std::size_t i = 0; i < plan.network.points.size(); ++i) {
    const NetworkPoint& point = plan.network.points[i];
    if (point.kind == PointKind::timed_literal) renumbered[i].offset = point.earliest;
    if (point.kind == PointKind::start || point.kind == PointKind::end) {
      renumbered[i].point = out.point_count++;
    }
  }
  for (const Activity& activity : plan.activities) {
    temporal::PlanActivity exported_activity = exported(activity, out.activities.size(), goals);
    exported_activity.start_point = renumbered[activity.start_point].point;
    exported_activity.end_point =
        activity.start_point == activity.end_point ? out.point_count++ : renumbered[activity.end_point].point;
    out.activities.push_back(std::move(exported_activity));
  }
  for (const temporal::TemporalConstraint& constraint : plan.network.constraints) {
    const Renumbered from = renumbered[constraint.from_point];
    const Renumbered to = renumbered[constraint.to_point];
    if (from.point == to.point) continue;  // between timed literals: true by construction
    if (constraint.kind == temporal::ConstraintKind::duration) continue;  // stands in the activity
    Duration lower = temporal::plus(constraint.lower, from.offset - to.offset);
    Duration upper = temporal::plus(constraint.upper, from.offset - to.offset);
    temporal::TemporalConstraint exported_constraint{from.point, to.point, constraint.kind, lower, upper};
    if (to.point == 0) {  // turned round, so that the origin comes first
      exported_constraint.from_point = to.point;
      exported_constraint.to_point = from.point;
      exported_constraint.lower = std::max(minus(Duration{0}, upper), Duration{0});
      exported_constraint.upper = minus(Duration{0}, lower);
    }
    if (from.offset != to.offset) exported_constraint.kind = temporal::ConstraintKind::window;
    exported_constraint.lower = exported_constraint.from_point == 0
                                    ? std::max(exported_constraint.lower, Duration{0})
                                    : exported_constraint.lower;
    out.constraints.push_back(exported_constraint);
  }
  for (const FunctionUse& use : functions) {
    if (use.answer.outcome != FunctionOutcome::value || !use.answer.is_exact() || !concerns(use, plan))
      continue;
    out.function_values.push_back(engine::recorded(use));
  }
  return out;
}

}  // namespace roci::planner::temporal_pddl::extraction
