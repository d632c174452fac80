// The syntax tree of a PDDL domain or problem covers PDDL 2.1 level 3, timed initial literals and derived
// predicates (2.2), timed initial fluents, and :modules of external functions (Stellar section 4.5, R35).
//
// Its nodes are plain values. All names are lower case. A tree from the parser has its types, arities and
// names checked only after check() (check.hpp). Equality compares what nodes say and ignores where they
// stand.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/pddl/box.hpp"
#include "core/pddl/source.hpp"

namespace roci::pddl {

// ---- Names, terms, types

/// Names a variable ("?x", with its question mark) or an object.
struct Term {
  std::string name;
  SourceLocation where;

  bool is_variable() const { return !name.empty() && name.front() == '?'; }
};

/// Declares a variable, object or type with its type(s): several alternatives for `(either a b)`, {"object"}
/// if untyped.
struct TypedName {
  std::string name;
  std::vector<std::string> types = {"object"};
  SourceLocation where;
};

/// Applies a predicate, fluent or external function to terms.
struct Atom {
  std::string symbol;
  std::vector<Term> arguments;
  SourceLocation where;
};

/// Declares a predicate, fluent or external function.
struct Signature {
  std::string name;
  std::vector<TypedName> parameters;
  SourceLocation where;
};

// ---- Numeric expressions

struct Expression;

/// Holds a number as the text has it.
struct Number {
  double value = 0;
};

struct DurationVariable {};  ///< ?duration
struct TotalTime {};         ///< total-time, in metrics
struct ContinuousTime {};    ///< #t: parsed so that it can be refused by name (forbidden.hpp)

/// Names the operators of numeric expressions.
enum class ArithmeticOperator { add, subtract, multiply, divide };

/// Joins operands: one operand with subtract is the negative; add and multiply take two or more, the others
/// two.
struct Arithmetic {
  ArithmeticOperator op = ArithmeticOperator::add;
  std::vector<Expression> operands;
};

/// Holds a numeric expression. An Atom stands for the value of a fluent, or of an external function if a
/// module declares its symbol.
struct Expression {
  std::variant<Number, Atom, DurationVariable, TotalTime, ContinuousTime, Arithmetic> node;
  SourceLocation where;
};

// ---- Conditions

struct Condition;

/// Holds if all parts hold; without parts it holds.
struct And {
  std::vector<Condition> parts;
};

/// Holds if one of the parts holds; without parts it does not hold.
struct Or {
  std::vector<Condition> parts;
};

/// Holds if the body does not.
struct Not {
  Box<Condition> body;
};

/// Holds if the premise does not, or the conclusion does.
struct Imply {
  Box<Condition> premise;
  Box<Condition> conclusion;
};

/// Holds if the body does for every choice of objects.
struct Forall {
  std::vector<TypedName> variables;
  Box<Condition> body;
};

/// Holds if the body does for some choice of objects.
struct Exists {
  std::vector<TypedName> variables;
  Box<Condition> body;
};

/// Holds if both terms are the same object: (= ?x ?y).
struct TermEquality {
  Term left;
  Term right;
};

/// Names the comparisons of numbers.
enum class ComparisonOperator { less, less_equal, equal, greater_equal, greater };

/// Compares two numeric expressions.
struct Comparison {
  ComparisonOperator op = ComparisonOperator::equal;
  Expression left;
  Expression right;
};

/// Holds a condition of any form.
struct Condition {
  std::variant<And, Or, Not, Imply, Forall, Exists, Atom, TermEquality, Comparison> node;
  SourceLocation where;
};

/// Holds the conditions of a durative action, sorted by time (the parser distributes `forall` and `and`
/// around `at start` and the like). What is not asked is the empty And. A plain action has only at_start.
struct TimedCondition {
  Condition at_start;
  Condition over_all;
  Condition at_end;
};

// ---- Effects

struct Effect;

/// Holds an atom or its negation.
struct Literal {
  Atom atom;
  bool negated = false;
};

/// Names the ways in which an effect changes a fluent.
enum class AssignmentOperator { assign, increase, decrease, scale_up, scale_down };

/// Changes a fluent to, or by, the value of an expression.
struct Assignment {
  AssignmentOperator op = AssignmentOperator::assign;
  Atom fluent;
  Expression value;
};

/// Describes a conditional effect. The condition may look at another time than the effect's own: the end
/// effect of `(when (at start (p)) (at end (q)))` has p in condition.at_start. `(at end (when (p) (q)))` has
/// it in condition.at_end, and a plain action in condition.at_start.
struct When {
  TimedCondition condition;
  std::vector<Effect> effects;
};

/// Has its effects for every choice of objects.
struct ForallEffect {
  std::vector<TypedName> variables;
  std::vector<Effect> effects;
};

/// Holds one effect; an `and` in effects is dissolved into the vector that holds it.
struct Effect {
  std::variant<Literal, Assignment, When, ForallEffect> node;
  SourceLocation where;
};

// ---- Actions

/// Describes an instantaneous action, (:action …).
struct Action {
  std::string name;
  std::vector<TypedName> parameters;
  Condition precondition;
  std::vector<Effect> effects;
  SourceLocation where;
};

/// Names the end of an action at which a bound is evaluated.
enum class TimePoint { start, end };

/// Says ?duration OP bound, where the bound is evaluated at the given point and OP is <=, = or >=.
struct DurationConstraint {
  ComparisonOperator op = ComparisonOperator::equal;
  Expression bound;
  TimePoint at = TimePoint::start;
  SourceLocation where;
};

/// Describes ⟨pre⊢, eff⊢, pre↔, pre⊣, eff⊣⟩ with bounds on the duration (R2); without any constraint every
/// duration ≥ 0 is allowed.
struct DurativeAction {
  std::string name;
  std::vector<TypedName> parameters;
  std::vector<DurationConstraint> duration;
  TimedCondition condition;
  std::vector<Effect> start_effects;
  std::vector<Effect> end_effects;
  /// Holds effects as `(increase (f) (* #t 2))`, outside of any `at`; see forbidden.hpp.
  std::vector<Effect> continuous_effects;
  SourceLocation where;
};

/// Defines a derived predicate, `(:derived (head ?x - t …) body)`.
struct DerivedPredicate {
  Signature head;
  Condition body;
};

// ---- Domain

/// Holds one entry of (:requirements …).
struct Requirement {
  std::string keyword;  ///< has its colon: ":typing"
  SourceLocation where;
};

/// Says that an external function takes a fluent into account, by levels of it: a value from one level up to
/// the next counts as that level.
struct StateDependence {
  std::string function;        ///< of the same module
  Atom fluent;                 ///< its arguments are parameters of the function
  std::vector<double> levels;  ///< ascending
  SourceLocation where;
};

/// Declares the external functions of one owner: they lead from objects to numbers and are constant for a
/// whole planning call, but for what they depend on.
struct Module {
  std::string name;
  std::vector<Signature> functions;
  /// There are none in a tree from load_domain(), see state_levels.hpp.
  std::vector<StateDependence> dependences;
  SourceLocation where;
};

/// Says what the parameters of an external function stand for that loading has added behind its own.
struct LevelParameter {
  std::string function;
  std::string fluent;                    ///< its symbol
  std::vector<std::size_t> arguments;    ///< of the fluent: positions among the function's parameters
  std::map<std::string, double> levels;  ///< by the object that stands for it
};

/// Holds a whole domain file; its lists keep the order of the text.
struct Domain {
  std::string file;  ///< as given to the parser, for messages
  std::string name;
  std::vector<Requirement> requirements;
  std::vector<TypedName> types;  ///< name and its supertype(s)
  std::vector<TypedName> constants;
  std::vector<Signature> predicates;
  std::vector<Signature> functions;
  std::vector<Module> modules;
  std::vector<DerivedPredicate> derived;
  std::vector<Action> actions;
  std::vector<DurativeAction> durative_actions;
  SourceLocation where;
  std::vector<Diagnostic> warnings;  ///< what departs from PDDL, and how it was read; no part of equality
  std::vector<LevelParameter> level_parameters;  ///< in the order of each function's; no part of equality
};

// ---- Problem

/// Holds an entry of :init: (= (f a) 3).
struct InitialValue {
  Atom fluent;
  double value = 0;
};

/// Holds a timed initial literal, (at 5 (p)) or (at 7 (not (p))), with its time in seconds.
struct TimedLiteral {
  double time = 0;
  Literal literal;
  SourceLocation where;
};

/// Holds a timed initial fluent, (at 5 (= (f a) 3)), with its time in seconds.
struct TimedValue {
  double time = 0;
  Atom fluent;
  double value = 0;
  SourceLocation where;
};

/// Holds the (:metric …) of a problem.
struct Metric {
  enum class Sense { minimize, maximize };
  Sense sense = Sense::minimize;
  Expression expression;
  SourceLocation where;
};

/// Holds a whole problem file; its lists keep the order of the text.
struct Problem {
  std::string file;  ///< as given to the parser, for messages
  std::string name;
  std::string domain_name;
  std::vector<Requirement> requirements;
  std::vector<TypedName> objects;
  std::vector<Atom> facts;           ///< true at time 0; everything else is false
  std::vector<Atom> false_facts;     ///< `(not (p))` in :init: says only what the closed world says anyway
  std::vector<InitialValue> values;  ///< the last one of a fluent counts
  std::vector<TimedLiteral> timed_literals;
  std::vector<TimedValue> timed_values;
  Condition goal;
  std::optional<Metric> metric;
  SourceLocation where;
  std::vector<Diagnostic> warnings;  ///< what departs from PDDL, and how it was read; no part of equality
};

// Equality compares what is said, wherever it stands (file names, locations and warnings are ignored).

bool operator==(const Term&, const Term&);
bool operator==(const TypedName&, const TypedName&);
bool operator==(const Atom&, const Atom&);
bool operator==(const Signature&, const Signature&);
bool operator==(const Expression&, const Expression&);
bool operator==(const Condition&, const Condition&);
bool operator==(const TimedCondition&, const TimedCondition&);
bool operator==(const Effect&, const Effect&);
bool operator==(const Action&, const Action&);
bool operator==(const DurativeAction&, const DurativeAction&);
bool operator==(const Domain&, const Domain&);
bool operator==(const Problem&, const Problem&);

}  // namespace roci::pddl
