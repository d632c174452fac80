#include "planner_svc/temporal_pddl/extraction/flexible_plan_export.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>

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

std::optional<ConditionOp> comparison_of(std::string_view symbol) {
  if (symbol == "<") return ConditionOp::lt;
  if (symbol == "<=") return ConditionOp::le;
  if (symbol == "=") return ConditionOp::eq;
  if (symbol == ">=") return ConditionOp::ge;
  if (symbol == ">") return ConditionOp::gt;
  return std::nullopt;
}

// "(>= (battery) 30)"; nothing for comparisons of more than one fluent.
std::optional<Condition> single_fluent_comparison(const std::string& text) {
  const auto fluent_begin = text.find('(', 1);
  const auto fluent_end = text.find(')');
  if (fluent_begin == std::string::npos || fluent_end == std::string::npos || fluent_end < fluent_begin)
    return std::nullopt;
  std::string symbol = text.substr(1, fluent_begin - 1);
  symbol.erase(symbol.find_last_not_of(' ') + 1);
  const auto op = comparison_of(symbol);
  const auto number_begin = text.find_first_not_of(' ', fluent_end + 1);
  if (!op || number_begin == std::string::npos) return std::nullopt;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data() + number_begin, text.data() + text.size(), number);
  if (error != std::errc() ||
      std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end)) != ")")
    return std::nullopt;
  return temporal::compare(text.substr(fluent_begin, fluent_end - fluent_begin + 1), *op, number);
}

std::optional<Condition> exported(const GroundCondition& condition) {
  using Kind = GroundCondition::Kind;
  switch (condition.kind) {
    case Kind::fact:
      return temporal::compare(condition.text, ConditionOp::eq, true);
    case Kind::negated_fact:
      return temporal::compare(condition.text, ConditionOp::eq, false);
    case Kind::comparison:
      return single_fluent_comparison(condition.text);
    case Kind::formula:
      return std::nullopt;
  }
  return std::nullopt;
}

// "(at place-1)" and "(not (at place-1))": the fact as a timeline becomes true or false.
temporal::Impact exported_fact(const std::string& text, temporal::ImpactWhen moment) {
  constexpr std::string_view kNot = "(not ";
  const bool becomes_false = text.starts_with(kNot);
  const std::string fact = becomes_false ? text.substr(kNot.size(), text.size() - kNot.size() - 1) : text;
  return {fact, temporal::ImpactKind::assign, moment, !becomes_false};
}

// "(decrease (battery) 12.5)" and "(increase …)" by a number, and facts; nothing for other effects.
std::optional<temporal::Impact> exported(const GroundEffect& effect, temporal::ImpactWhen moment) {
  const bool less = effect.text.starts_with("(decrease ");
  if (!less && !effect.text.starts_with("(increase ")) {
    constexpr std::array kOfNumbers{"(assign ", "(scale-up ", "(scale-down "};
    const bool of_number = std::any_of(kOfNumbers.begin(), kOfNumbers.end(),
                                       [&](const char* start) { return effect.text.starts_with(start); });
    return of_number ? std::nullopt : std::optional(exported_fact(effect.text, moment));
  }
  const auto amount =
      single_fluent_comparison("(= " + effect.text.substr(std::string_view("(decrease ").size()));
  if (!amount) return std::nullopt;
  const temporal::ConditionNode& node = amount->nodes.front();
  const double number = std::get<double>(node.operand);
  return temporal::Impact{node.timeline, temporal::ImpactKind::delta, moment, less ? -number : number};
}

bool achieved_by(const GroundCondition& condition, const std::vector<GroundEffect>& effects) {
  const std::string wanted =
      condition.kind == GroundCondition::Kind::negated_fact ? "(not " + condition.text + ")" : condition.text;
  return std::any_of(effects.begin(), effects.end(),
                     [&](const GroundEffect& effect) { return effect.text == wanted; });
}

Condition conjunction(const std::vector<Condition>& parts) {
  return parts.empty() ? Condition{} : temporal::all_of(parts);
}

temporal::PlanActivity exported(const Activity& in, std::size_t index) {
  temporal::PlanActivity out;
  out.id = "a" + std::to_string(index + 1);
  out.name = in.name;
  for (std::size_t i = 0; i < in.arguments.size(); ++i)
    out.arguments.push_back({std::to_string(i + 1), in.arguments[i]});
  out.duration_lower = in.durative ? in.min_duration : Duration{0};
  out.duration_upper = in.durative ? in.max_duration : Duration{0};
  std::vector<Condition> pre, maintenance;
  for (const GroundCondition& condition : in.at_start) {
    if (auto part = exported(condition)) pre.push_back(std::move(*part));
  }
  for (const GroundCondition& condition : in.over_all) {
    auto part = exported(condition);
    if (!part) continue;
    if (!achieved_by(condition, in.start_effects)) pre.push_back(*part);
    maintenance.push_back(std::move(*part));
  }
  for (const GroundEffect& effect : in.start_effects) {
    if (auto impact = exported(effect, temporal::ImpactWhen::at_start))
      out.impacts.push_back(std::move(*impact));
  }
  for (const GroundEffect& effect : in.end_effects) {
    if (auto impact = exported(effect, temporal::ImpactWhen::at_end))
      out.impacts.push_back(std::move(*impact));
  }
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

temporal::FlexiblePlan export_plan(const Plan& plan, const std::vector<FunctionUse>& functions) {
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
    temporal::PlanActivity exported_activity = exported(activity, out.activities.size());
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
    if (use.answer.outcome != FunctionOutcome::value || !concerns(use, plan)) continue;
    std::uint64_t version = 0;
    const std::string& text = use.answer.provenance.model_version;
    std::from_chars(text.data(), text.data() + text.size(), version);
    out.function_values.push_back({use.call.function, use.call.arguments, use.answer.value,
                                   use.answer.provenance.owner, version, use.answer.provenance.time});
  }
  return out;
}

}  // namespace roci::planner::temporal_pddl::extraction
