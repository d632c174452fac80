// The model with numbers for names, in negation normal form: what instantiation works on.
//
// Variables are slots of a binding: first the parameters of the action, then one per quantified variable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl {

struct Argument {
  bool is_slot = false;
  std::uint32_t index = 0;  // of a slot, else of an object
};

// One object per slot; unbound slots hold none.
using Binding = std::vector<ObjectId>;

inline ObjectId resolve(Argument argument, const Binding& binding) {
  return argument.is_slot ? binding[argument.index] : ObjectId(argument.index);
}

struct QuantifiedSlot {
  std::uint32_t slot = 0;
  std::vector<ObjectId> domain;
};

struct LiftedAtom {
  PredicateId predicate;
  std::vector<Argument> arguments;
};

struct LiftedExpression {
  enum class Kind { kNumber, kFunction, kDuration, kArithmetic };
  Kind kind = Kind::kNumber;
  double number = 0;
  FunctionId function;
  std::vector<Argument> arguments;
  pddl::ArithmeticOperator op = pddl::ArithmeticOperator::kAdd;
  std::vector<LiftedExpression> operands;
  pddl::SourceLocation where;
};

struct LiftedFormula {
  enum class Kind { kAnd, kOr, kForall, kExists, kAtom, kNotAtom, kEqual, kNotEqual, kComparison };
  Kind kind = Kind::kAnd;
  std::vector<LiftedFormula> parts;        // kAnd (empty: true), kOr (empty: false); one for kForall, kExists
  std::vector<QuantifiedSlot> quantified;  // kForall, kExists
  LiftedAtom atom;                         // kAtom, kNotAtom; kEqual, kNotEqual: its two arguments
  pddl::ComparisonOperator comparison = pddl::ComparisonOperator::kEqual;
  std::vector<LiftedExpression> sides;  // kComparison: left, right
  pddl::SourceLocation where;

  bool is_true() const { return kind == Kind::kAnd && parts.empty(); }
};

// An effect for every value of the quantified slots, if the condition holds: at the start (tested before the
// start) or at the end (tested before the end).
struct LiftedEffect {
  enum class Kind { kAdd, kDelete, kNumeric };
  Kind kind = Kind::kAdd;
  std::vector<QuantifiedSlot> quantified;
  LiftedFormula start_condition, start_otherwise;  // the condition and its negation
  LiftedFormula end_condition, end_otherwise;
  LiftedAtom atom;
  FunctionId function;  // kNumeric; its arguments stand in atom
  pddl::AssignmentOperator op = pddl::AssignmentOperator::kAssign;
  LiftedExpression value;
  pddl::SourceLocation where;

  bool conditional() const { return !start_condition.is_true() || !end_condition.is_true(); }
};

struct LiftedDuration {
  pddl::ComparisonOperator op = pddl::ComparisonOperator::kEqual;
  LiftedExpression bound;
  pddl::TimePoint at = pddl::TimePoint::kStart;
};

struct LiftedAction {
  std::string name;
  bool durative = true;
  std::vector<std::vector<ObjectId>> parameters;  // the objects that each may be, ascending
  std::uint32_t slots = 0;                        // parameters and quantified variables
  std::vector<LiftedDuration> duration;
  LiftedFormula at_start, over_all, at_end;
  std::vector<LiftedEffect> start_effects, end_effects;
  pddl::SourceLocation where;
};

}  // namespace roci::planner::temporal_pddl
