// The static model is what is known before anything happens: which predicates never change and what holds at
// first.
#pragma once

#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/short_list.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Holds a timed initial literal.
struct TimedAtom {
  double time = 0;  ///< seconds, > 0
  task::PredicateId predicate;
  std::vector<task::ObjectId> objects;
  bool negated = false;
};

/// Answers what is known before anything happens. Symbols and constants must outlive it.
class StaticModel {
 public:
  StaticModel(const pddl::Problem& problem, const std::vector<LiftedAction>& actions, const Symbols& symbols,
              const ConstantFunctions& constants);

  const Symbols& symbols() const { return symbols_; }
  const ConstantFunctions& constants() const { return constants_; }
  const TupleTable& initial_atoms() const { return initial_; }          ///< timed literals at time 0 included
  const std::vector<TimedAtom>& timed_atoms() const { return timed_; }  ///< stand in order of time

  bool is_derived(task::PredicateId predicate) const { return derived_[predicate]; }
  bool is_static(task::PredicateId predicate) const { return static_[predicate]; }
  bool holds_initially(task::PredicateId predicate, std::span<const task::ObjectId> objects) const {
    return initial_.find(predicate.value, objects).has_value();
  }

  /// Returns whether the formula is not false for what never changes alone. All slots but quantified ones
  /// are bound; those are left unbound.
  bool possible(const LiftedFormula& formula, Binding& binding) const;
  /// Returns whether all constants in the expression have a value.
  bool defined(const LiftedExpression& expression, const Binding& binding) const;
  /// Returns the value of an expression without fluents and ?duration. Returns nothing for others, and where
  /// a constant is undefined.
  std::optional<double> constant_value(const LiftedExpression& expression, const Binding& binding) const;

 private:
  const Symbols& symbols_;
  const ConstantFunctions& constants_;
  task::IdVector<task::PredicateId, bool> static_, derived_;
  TupleTable initial_;
  std::vector<TimedAtom> timed_;
};

/// Holds the objects of an atom; those of most atoms without the heap.
using Objects = task::ShortList<task::ObjectId, 8>;

/// Returns the objects of the atom under a binding.
Objects objects_of(const std::vector<Argument>& arguments, const Binding& binding);

/// Calls visit() for every value of the slots, from `first` on, leaving `binding` as it was.
template <typename Visit>
void for_each_value(const std::vector<QuantifiedSlot>& slots, Binding& binding, Visit&& visit,
                    std::size_t first = 0) {
  if (first == slots.size()) {
    visit();
    return;
  }
  for (const task::ObjectId object : slots[first].domain) {
    binding[slots[first].slot] = object;
    for_each_value(slots, binding, visit, first + 1);
  }
  binding[slots[first].slot] = task::ObjectId();
}

/// Returns whether left OP right holds.
bool compare(pddl::ComparisonOperator op, double left, double right);

/// Returns the operands combined from left to right; there is at least one, and a single one with subtract is
/// negated.
double combine(pddl::ArithmeticOperator op, const std::vector<double>& operands);

}  // namespace roci::planner::temporal_pddl::grounding::lifted
