#include "services/wire/plan_wire.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "core/temporal/plan_bounds.hpp"

namespace roci::services::wire {
namespace {

using temporal::Duration;

temporal::Duration bound_from_wire(std::int64_t bound) {
  return bound < 0 ? temporal::no_bound : temporal::Duration(bound);
}

// Enumerations have the same order on both sides.
template <class Wire, class Core>
Wire enum_to_wire(Core value) {
  return static_cast<Wire>(static_cast<std::uint32_t>(value));
}

template <class Core, class Wire>
Core enum_from_wire(Wire value, Core last, const char* what) {
  if (static_cast<std::uint32_t>(value) > static_cast<std::uint32_t>(last)) {
    throw WireError(std::string(what) +
                    " out of range: " + std::to_string(static_cast<std::uint32_t>(value)));
  }
  return static_cast<Core>(static_cast<std::uint32_t>(value));
}

template <class Out, class In, class F>
std::vector<Out> each(const std::vector<In>& in, F&& translate) {
  std::vector<Out> out;
  out.reserve(in.size());
  std::transform(in.begin(), in.end(), std::back_inserter(out), translate);
  return out;
}

std::vector<v1::Property> properties_to_wire(const std::vector<temporal::Property>& in) {
  return each<v1::Property>(in, [](const temporal::Property& p) { return to_wire(p); });
}

std::vector<temporal::Property> properties_from_wire(const std::vector<v1::Property>& in) {
  return each<temporal::Property>(in, [](const v1::Property& p) {
    return temporal::Property{p.name(), p.value()};
  });
}

v1::PlanCommand command_to_wire(const temporal::PlanCommand& in) {
  v1::PlanCommand out;
  out.owner(in.owner);
  out.robot(in.robot);
  out.subsystem(in.subsystem);
  out.command_name(in.command_name);
  out.arguments(properties_to_wire(in.arguments));
  out.answer_within_us(bound_to_wire(in.answer_within));
  return out;
}

temporal::PlanCommand command_from_wire(const v1::PlanCommand& in) {
  return {in.owner(),
          in.robot(),
          in.subsystem(),
          in.command_name(),
          properties_from_wire(in.arguments()),
          bound_from_wire(in.answer_within_us())};
}

// The first command stands in the activity itself, those that follow in a list.
std::vector<v1::PlanCommand> commands_to_wire(const temporal::PlanActivity& in) {
  std::vector<v1::PlanCommand> out;
  if (in.owner.empty()) return out;
  out.push_back(command_to_wire(temporal::PlanCommand{in.owner, in.robot, in.subsystem, in.command_name,
                                                      in.arguments, in.answer_within}));
  for (const temporal::PlanCommand& command : in.then) out.push_back(command_to_wire(command));
  return out;
}

void commands_from_wire(const std::vector<v1::PlanCommand>& in, temporal::PlanActivity& out) {
  if (in.empty()) return;
  temporal::PlanCommand first = command_from_wire(in.front());
  out.owner = std::move(first.owner);
  out.robot = std::move(first.robot);
  out.subsystem = std::move(first.subsystem);
  out.command_name = std::move(first.command_name);
  out.arguments = std::move(first.arguments);
  out.answer_within = first.answer_within;
  for (std::size_t i = 1; i < in.size(); ++i) out.then.push_back(command_from_wire(in[i]));
}

v1::PlanActivity activity_to_wire(const temporal::PlanActivity& in) {
  v1::PlanActivity out;
  out.id(in.id);
  out.name(in.name);
  out.level(in.level);
  out.parent(in.parent);
  if (in.owner.empty()) out.arguments(properties_to_wire(in.arguments));
  out.commands(commands_to_wire(in));
  out.start_point(in.start_point);
  out.end_point(in.end_point);
  out.duration_lower_us(in.duration_lower.count());
  out.duration_upper_us(bound_to_wire(in.duration_upper));
  out.preferred_start_us(bound_to_wire(in.preferred_start));
  out.pre(to_wire(in.pre));
  out.maintenance(to_wire(in.maintenance));
  out.post(to_wire(in.post));
  out.impacts(each<v1::Impact>(in.impacts, [](const temporal::Impact& impact) {
    v1::Impact wire;
    wire.timeline(impact.timeline);
    wire.kind(enum_to_wire<v1::ImpactKind>(impact.kind));
    wire.moment(enum_to_wire<v1::ImpactWhen>(impact.moment));
    wire.amount(to_wire(impact.amount));
    return wire;
  }));
  out.wait_timeout_us(bound_to_wire(in.wait_timeout));
  out.retries(in.retries);
  out.may_skip(in.may_skip);
  out.skip_if(to_wire(in.skip_if));
  out.lateness(enum_to_wire<v1::LatenessPolicy>(in.lateness));
  out.commit(enum_to_wire<v1::CommitState>(in.commit));
  out.failure(enum_to_wire<v1::FailureScope>(in.failure));
  out.contingency(in.contingency);
  out.priority(in.priority);
  out.goals_served(in.goals_served);
  out.utility(in.utility.scores());
  return out;
}

temporal::PlanActivity activity_from_wire(const v1::PlanActivity& in) {
  temporal::PlanActivity out;
  out.id = in.id();
  out.name = in.name();
  out.level = in.level();
  out.parent = in.parent();
  out.arguments = properties_from_wire(in.arguments());
  commands_from_wire(in.commands(), out);
  out.start_point = in.start_point();
  out.end_point = in.end_point();
  out.duration_lower = temporal::Duration(in.duration_lower_us());
  out.duration_upper = bound_from_wire(in.duration_upper_us());
  out.preferred_start = bound_from_wire(in.preferred_start_us());
  out.pre = from_wire(in.pre());
  out.maintenance = from_wire(in.maintenance());
  out.post = from_wire(in.post());
  out.impacts = each<temporal::Impact>(in.impacts(), [](const v1::Impact& impact) {
    return temporal::Impact{impact.timeline(),
                            enum_from_wire(impact.kind(), temporal::ImpactKind::rate, "impact kind"),
                            enum_from_wire(impact.moment(), temporal::ImpactWhen::during, "impact moment"),
                            from_wire(impact.amount())};
  });
  out.wait_timeout = bound_from_wire(in.wait_timeout_us());
  out.retries = in.retries();
  out.may_skip = in.may_skip();
  out.skip_if = from_wire(in.skip_if());
  out.lateness = enum_from_wire(in.lateness(), temporal::LatenessPolicy::deadline, "lateness policy");
  out.commit = enum_from_wire(in.commit(), temporal::CommitState::committed, "commit state");
  out.failure = enum_from_wire(in.failure(), temporal::FailureScope::of_activity, "failure scope");
  out.contingency = in.contingency();
  out.priority = in.priority();
  out.goals_served = in.goals_served();
  out.utility = temporal::RankVector(in.utility());
  return out;
}

v1::DecisionPoint decision_to_wire(const temporal::DecisionPoint& in) {
  v1::DecisionPoint out;
  out.id(in.id);
  out.resolver_kind(enum_to_wire<v1::ResolverKind>(in.resolver_kind));
  out.resolver(in.resolver);
  out.choices(each<v1::DecisionChoice>(in.choices, [](const temporal::DecisionChoice& choice) {
    v1::DecisionChoice wire;
    wire.name(choice.name);
    wire.activities(choice.activities);
    wire.rule(to_wire(choice.rule));
    return wire;
  }));
  out.bindings(each<v1::ArgumentBinding>(in.bindings, [](const temporal::ArgumentBinding& binding) {
    v1::ArgumentBinding wire;
    wire.activity(binding.activity);
    wire.argument(binding.argument);
    return wire;
  }));
  out.admissible(in.admissible);
  out.decide_before(in.decide_before);
  return out;
}

temporal::DecisionPoint decision_from_wire(const v1::DecisionPoint& in) {
  temporal::DecisionPoint out;
  out.id = in.id();
  out.resolver_kind = enum_from_wire(in.resolver_kind(), temporal::ResolverKind::rule, "resolver");
  out.resolver = in.resolver();
  out.choices = each<temporal::DecisionChoice>(in.choices(), [](const v1::DecisionChoice& choice) {
    return temporal::DecisionChoice{choice.name(), choice.activities(), from_wire(choice.rule())};
  });
  out.bindings = each<temporal::ArgumentBinding>(in.bindings(), [](const v1::ArgumentBinding& binding) {
    return temporal::ArgumentBinding{binding.activity(), binding.argument()};
  });
  out.admissible = in.admissible();
  out.decide_before = in.decide_before();
  return out;
}

v1::Token token_to_wire(const temporal::Token& in) {
  v1::Token out;
  out.timeline(in.timeline);
  out.held(to_wire(in.held));
  out.start_point(in.start_point);
  out.end_point(in.end_point);
  return out;
}

temporal::Token token_from_wire(const v1::Token& in) {
  return {in.timeline(), from_wire(in.held()), in.start_point(), in.end_point()};
}

v1::TemporalConstraint constraint_to_wire(const temporal::TemporalConstraint& in) {
  v1::TemporalConstraint out;
  out.from_point(in.from_point);
  out.to_point(in.to_point);
  out.kind(enum_to_wire<v1::ConstraintKind>(in.kind));
  out.lower_us(in.lower.count());
  out.upper_us(bound_to_wire(in.upper));
  return out;
}

temporal::TemporalConstraint constraint_from_wire(const v1::TemporalConstraint& in) {
  return {in.from_point(), in.to_point(),
          enum_from_wire(in.kind(), temporal::ConstraintKind::window, "constraint kind"),
          temporal::Duration(in.lower_us()), bound_from_wire(in.upper_us())};
}

v1::FunctionValueUse use_to_wire(const temporal::FunctionValueUse& in) {
  v1::FunctionValueUse out;
  out.function(in.function);
  out.arguments(in.arguments);
  out.number(in.number);
  out.accuracy(enum_to_wire<v1::FunctionAccuracy>(in.accuracy));
  out.owner(in.owner);
  out.model_version(in.model_version);
  out.computed_us(in.computed.count());
  return out;
}

}  // namespace

v1::Property to_wire(const temporal::Property& in) {
  v1::Property out;
  out.name(in.name);
  out.value(in.value);
  return out;
}

std::int64_t bound_to_wire(temporal::Duration bound) {
  return bound == temporal::no_bound ? -1 : bound.count();
}

v1::TimelineValue to_wire(const temporal::Value& in) {
  v1::TimelineValue out;
  out.kind(static_cast<v1::ValueKind>(in.index()));
  if (const auto* truth = std::get_if<bool>(&in)) out.truth(*truth);
  if (const auto* number = std::get_if<double>(&in)) out.number(*number);
  if (const auto* state = std::get_if<temporal::State>(&in)) {
    out.state(state->name);
    out.arguments(state->arguments);
  }
  return out;
}

temporal::Value from_wire(const v1::TimelineValue& in) {
  switch (in.kind()) {
    case v1::VALUE_NONE:
      return {};
    case v1::VALUE_BOOLEAN:
      return in.truth();
    case v1::VALUE_NUMBER:
      return in.number();
    case v1::VALUE_STATE:
      return temporal::state(in.state(), in.arguments());
  }
  throw WireError("value kind out of range: " + std::to_string(static_cast<std::uint32_t>(in.kind())));
}

v1::Condition to_wire(const temporal::Condition& in) {
  v1::Condition out;
  out.nodes(each<v1::ConditionNode>(in.nodes, [](const temporal::ConditionNode& node) {
    v1::ConditionNode wire;
    wire.op(enum_to_wire<v1::ConditionOp>(node.op));
    wire.child_count(node.child_count);
    wire.timeline(node.timeline);
    wire.operand(to_wire(node.operand));
    return wire;
  }));
  return out;
}

temporal::Condition from_wire(const v1::Condition& in) {
  if (in.nodes().size() > temporal::kMostConditionNodes)
    throw WireError("a condition has more than " + std::to_string(temporal::kMostConditionNodes) + " nodes");
  return {each<temporal::ConditionNode>(in.nodes(), [](const v1::ConditionNode& node) {
    return temporal::ConditionNode{enum_from_wire(node.op(), temporal::ConditionOp::gt, "condition operator"),
                                   node.child_count(), node.timeline(), from_wire(node.operand())};
  })};
}

v1::Plan to_wire(const temporal::FlexiblePlan& in) {
  v1::Plan out;
  out.id(in.id);
  out.version(in.version);
  out.engine(in.engine);
  out.origin_us(in.origin.count());
  out.point_count(in.point_count);
  out.activities(each<v1::PlanActivity>(in.activities, activity_to_wire));
  out.tokens(each<v1::Token>(in.tokens, token_to_wire));
  out.decisions(each<v1::DecisionPoint>(in.decisions, decision_to_wire));
  out.constraints(each<v1::TemporalConstraint>(in.constraints, constraint_to_wire));
  out.function_values(each<v1::FunctionValueUse>(in.function_values, use_to_wire));
  return out;
}

temporal::FlexiblePlan from_wire(const v1::Plan& in) {
  if (in.point_count() > temporal::kMostPoints)
    throw WireError("a plan has more than " + std::to_string(temporal::kMostPoints) + " time points");
  temporal::FlexiblePlan out;
  out.id = in.id();
  out.version = in.version();
  out.engine = in.engine();
  out.origin = temporal::Duration(in.origin_us());
  out.point_count = in.point_count();
  out.activities = each<temporal::PlanActivity>(in.activities(), activity_from_wire);
  out.tokens = each<temporal::Token>(in.tokens(), token_from_wire);
  out.decisions = each<temporal::DecisionPoint>(in.decisions(), decision_from_wire);
  out.constraints = each<temporal::TemporalConstraint>(in.constraints(), constraint_from_wire);
  out.function_values =
      each<temporal::FunctionValueUse>(in.function_values(), [](const v1::FunctionValueUse& use) {
        return temporal::FunctionValueUse{
            use.function(),
            use.arguments(),
            use.number(),
            use.owner(),
            use.model_version(),
            temporal::Time(use.computed_us()),
            enum_from_wire(use.accuracy(), temporal::FunctionAccuracy::estimate, "accuracy")};
      });
  return out;
}

v1::PlanDelta to_wire(const temporal::PlanDelta& in) {
  v1::PlanDelta out;
  out.from_version(in.from_version);
  out.added(to_wire(in.added));
  out.removed_activities(in.removed_activities);
  out.removed_decisions(in.removed_decisions);
  out.removed_tokens(each<v1::Token>(in.removed_tokens, token_to_wire));
  out.removed_constraints(each<v1::TemporalConstraint>(in.removed_constraints, constraint_to_wire));
  return out;
}

temporal::PlanDelta from_wire(const v1::PlanDelta& in) {
  return {in.from_version(),
          from_wire(in.added()),
          in.removed_activities(),
          in.removed_decisions(),
          each<temporal::Token>(in.removed_tokens(), token_from_wire),
          each<temporal::TemporalConstraint>(in.removed_constraints(), constraint_from_wire)};
}

}  // namespace roci::services::wire
