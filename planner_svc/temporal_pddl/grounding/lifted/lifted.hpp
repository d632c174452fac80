// The lifted model has numbers for names and is in negation normal form; instantiation works on it.
//
// Variables are slots of a binding: first the parameters of the action, then one per quantified variable.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Names an argument of an atom or a function: a slot of the binding, or an object.
struct Argument {
  bool is_slot = false;
  std::uint32_t index = 0;  ///< the index of a slot, else of an object
};

/// Binds one object to each slot; unbound slots hold none.
using Binding = std::vector<task::ObjectId>;

/// Returns the object that the argument is under the binding.
inline task::ObjectId resolve(Argument argument, const Binding& binding) {
  return argument.is_slot ? binding[argument.index] : task::ObjectId(argument.index);
}

/// An action or goal may have so many slots at most: whatever runs through their values may recurse that deep.
inline constexpr std::uint32_t kMaxSlots = 256;

/// Holds a slot of a quantified variable with the objects that it may take.
struct QuantifiedSlot {
  std::uint32_t slot = 0;
  std::vector<task::ObjectId> domain;
};

/// Holds a predicate with arguments.
struct LiftedAtom {
  task::PredicateId predicate;
  std::vector<Argument> arguments;
};

/// Holds a numeric expression over slots and objects.
struct LiftedExpression {
  enum class Kind {
    number,
    function,
    duration,
    arithmetic
  };  // duration: of the action, in a metric of the plan
  Kind kind = Kind::number;
  double number = 0;
  task::FunctionId function;
  std::vector<Argument> arguments;
  pddl::ArithmeticOperator op = pddl::ArithmeticOperator::add;
  std::vector<LiftedExpression> operands;
  pddl::SourceLocation where;
};

/// Holds a condition in negation normal form.
struct LiftedFormula {
  enum class Kind { conjunction, disjunction, forall, exists, atom, not_atom, equal, not_equal, comparison };
  Kind kind = Kind::conjunction;
  // Holds the parts of a conjunction (true if empty) or disjunction (false if empty), and one part for forall
  // and exists.
  std::vector<LiftedFormula> parts;
  std::vector<QuantifiedSlot> quantified;  ///< forall, exists
  LiftedAtom atom;                         ///< atom, not_atom; equal, not_equal: its two arguments
  pddl::ComparisonOperator comparison = pddl::ComparisonOperator::equal;
  std::vector<LiftedExpression> sides;  ///< comparison: left, right
  pddl::SourceLocation where;

  bool is_true() const { return kind == Kind::conjunction && parts.empty(); }
};

/// Describes an effect that happens for every value of the quantified slots if the condition holds: at the
/// start (tested before the start) or at the end (tested before the end).
struct LiftedEffect {
  enum class Kind { add, remove, numeric };
  Kind kind = Kind::add;
  std::vector<QuantifiedSlot> quantified;
  LiftedFormula start_condition, start_otherwise;  ///< the condition and its negation
  LiftedFormula end_condition, end_otherwise;
  LiftedAtom atom;
  task::FunctionId function;  ///< numeric; its arguments stand in atom
  pddl::AssignmentOperator op = pddl::AssignmentOperator::assign;
  LiftedExpression value;
  pddl::SourceLocation where;

  bool conditional() const { return !start_condition.is_true() || !end_condition.is_true(); }
};

/// Constrains ?duration by a bound that is evaluated at the start or at the end.
struct LiftedDuration {
  pddl::ComparisonOperator op = pddl::ComparisonOperator::equal;
  LiftedExpression bound;
  pddl::TimePoint at = pddl::TimePoint::start;
};

/// Describes an action, or a rule of a derived predicate, over slots.
struct LiftedAction {
  std::string name;
  bool durative = true;
  std::optional<int> layer;  ///< set: no action, but a rule that derives its one start effect from at_start
  std::vector<std::vector<task::ObjectId>> parameters;  ///< the objects that each may be, ascending
  std::uint32_t slots = 0;                              ///< parameters and quantified variables
  std::vector<LiftedDuration> duration;
  LiftedFormula at_start, over_all, at_end;
  std::vector<LiftedEffect> start_effects, end_effects;
  pddl::SourceLocation where;
};

}  // namespace roci::planner::temporal_pddl::grounding::lifted
