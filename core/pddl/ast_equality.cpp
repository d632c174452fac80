// operator== of the tree goes member by member, without locations and file names.
#include <tuple>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

bool operator==(const Term& a, const Term& b) { return a.name == b.name; }

bool operator==(const TypedName& a, const TypedName& b) { return a.name == b.name && a.types == b.types; }

bool operator==(const Atom& a, const Atom& b) { return a.symbol == b.symbol && a.arguments == b.arguments; }

bool operator==(const Signature& a, const Signature& b) {
  return a.name == b.name && a.parameters == b.parameters;
}

// ---- Expressions (alternatives are compared by the variant)

static bool operator==(const Number& a, const Number& b) { return a.value == b.value; }
static bool operator==(const DurationVariable&, const DurationVariable&) { return true; }
static bool operator==(const TotalTime&, const TotalTime&) { return true; }
static bool operator==(const ContinuousTime&, const ContinuousTime&) { return true; }
static bool operator==(const Arithmetic& a, const Arithmetic& b) {
  return a.op == b.op && a.operands == b.operands;
}

bool operator==(const Expression& a, const Expression& b) { return a.node == b.node; }

// ---- Conditions

static bool operator==(const And& a, const And& b) { return a.parts == b.parts; }
static bool operator==(const Or& a, const Or& b) { return a.parts == b.parts; }
static bool operator==(const Not& a, const Not& b) { return *a.body == *b.body; }
static bool operator==(const Imply& a, const Imply& b) {
  return *a.premise == *b.premise && *a.conclusion == *b.conclusion;
}
static bool operator==(const Forall& a, const Forall& b) {
  return a.variables == b.variables && *a.body == *b.body;
}
static bool operator==(const Exists& a, const Exists& b) {
  return a.variables == b.variables && *a.body == *b.body;
}
static bool operator==(const TermEquality& a, const TermEquality& b) {
  return a.left == b.left && a.right == b.right;
}
static bool operator==(const Comparison& a, const Comparison& b) {
  return a.op == b.op && a.left == b.left && a.right == b.right;
}

bool operator==(const Condition& a, const Condition& b) { return a.node == b.node; }

bool operator==(const TimedCondition& a, const TimedCondition& b) {
  return a.at_start == b.at_start && a.over_all == b.over_all && a.at_end == b.at_end;
}

// ---- Effects

static bool operator==(const Literal& a, const Literal& b) {
  return a.negated == b.negated && a.atom == b.atom;
}
static bool operator==(const Assignment& a, const Assignment& b) {
  return a.op == b.op && a.fluent == b.fluent && a.value == b.value;
}
static bool operator==(const When& a, const When& b) {
  return a.condition == b.condition && a.effects == b.effects;
}
static bool operator==(const ForallEffect& a, const ForallEffect& b) {
  return a.variables == b.variables && a.effects == b.effects;
}

bool operator==(const Effect& a, const Effect& b) { return a.node == b.node; }

// ---- Actions, domain, problem

bool operator==(const Action& a, const Action& b) {
  return std::tie(a.name, a.parameters, a.precondition, a.effects) ==
         std::tie(b.name, b.parameters, b.precondition, b.effects);
}

static bool operator==(const DurationConstraint& a, const DurationConstraint& b) {
  return a.op == b.op && a.at == b.at && a.bound == b.bound;
}

bool operator==(const DurativeAction& a, const DurativeAction& b) {
  return std::tie(a.name, a.parameters, a.duration, a.condition, a.start_effects, a.end_effects,
                  a.continuous_effects) == std::tie(b.name, b.parameters, b.duration, b.condition,
                                                    b.start_effects, b.end_effects, b.continuous_effects);
}

static bool operator==(const Requirement& a, const Requirement& b) { return a.keyword == b.keyword; }

static bool operator==(const StateDependence& a, const StateDependence& b) {
  return a.function == b.function && a.fluent == b.fluent && a.levels == b.levels;
}

static bool operator==(const Module& a, const Module& b) {
  return a.name == b.name && a.functions == b.functions && a.dependences == b.dependences;
}

static bool operator==(const DerivedPredicate& a, const DerivedPredicate& b) {
  return a.head == b.head && a.body == b.body;
}

bool operator==(const Domain& a, const Domain& b) {
  return std::tie(a.name, a.requirements, a.types, a.constants, a.predicates, a.functions, a.modules,
                  a.derived, a.actions, a.durative_actions) ==
         std::tie(b.name, b.requirements, b.types, b.constants, b.predicates, b.functions, b.modules,
                  b.derived, b.actions, b.durative_actions);
}

static bool operator==(const InitialValue& a, const InitialValue& b) {
  return a.value == b.value && a.fluent == b.fluent;
}

static bool operator==(const TimedLiteral& a, const TimedLiteral& b) {
  return a.time == b.time && a.literal == b.literal;
}

static bool operator==(const TimedValue& a, const TimedValue& b) {
  return a.time == b.time && a.value == b.value && a.fluent == b.fluent;
}

static bool operator==(const Metric& a, const Metric& b) {
  return a.sense == b.sense && a.expression == b.expression;
}

bool operator==(const Problem& a, const Problem& b) {
  return std::tie(a.name, a.domain_name, a.requirements, a.objects, a.facts, a.false_facts, a.values,
                  a.timed_literals, a.timed_values, a.goal, a.metric) ==
         std::tie(b.name, b.domain_name, b.requirements, b.objects, b.facts, b.false_facts, b.values,
                  b.timed_literals, b.timed_values, b.goal, b.metric);
}

}  // namespace roci::pddl
