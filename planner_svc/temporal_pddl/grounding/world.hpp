// What is known of the model before anything happens: which predicates never change, what holds at first.
#pragma once

#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/tuple_table.hpp"

namespace roci::planner::temporal_pddl {

struct TimedAtom {
  double time = 0;  // seconds, > 0
  PredicateId predicate;
  std::vector<ObjectId> objects;
  bool negated = false;
};

class World {
 public:
  World(const pddl::Problem& problem, const std::vector<LiftedAction>& actions, const Symbols& symbols,
        const ConstantFunctions& constants);

  const Symbols& symbols() const { return symbols_; }
  const ConstantFunctions& constants() const { return constants_; }
  const TupleTable& initial_atoms() const { return initial_; }          // timed literals at time 0 included
  const std::vector<TimedAtom>& timed_atoms() const { return timed_; }  // by time

  bool is_derived(PredicateId predicate) const { return derived_[predicate]; }
  bool is_static(PredicateId predicate) const { return static_[predicate]; }
  bool holds_initially(PredicateId predicate, std::span<const ObjectId> objects) const {
    return initial_.find(predicate.value, objects).has_value();
  }

  // Is the formula not false for what never changes alone? All slots but quantified ones are bound; those are
  // left unbound.
  bool possible(const LiftedFormula& formula, Binding& binding) const;
  // Do all constants in the expression have a value?
  bool defined(const LiftedExpression& expression, const Binding& binding) const;
  // The value of an expression without fluents and ?duration; none for others, and where a constant is
  // undefined.
  std::optional<double> constant_value(const LiftedExpression& expression, const Binding& binding) const;

 private:
  const Symbols& symbols_;
  const ConstantFunctions& constants_;
  IdVector<PredicateId, bool> static_, derived_;
  TupleTable initial_;
  std::vector<TimedAtom> timed_;
};

// The atom's objects under a binding.
std::vector<ObjectId> objects_of(const std::vector<Argument>& arguments, const Binding& binding);

// Calls visit() for every value of the slots, from `first` on, leaving `binding` as it was.
template <typename Visit>
void for_each_value(const std::vector<QuantifiedSlot>& slots, Binding& binding, Visit&& visit,
                    std::size_t first = 0) {
  if (first == slots.size()) {
    visit();
    return;
  }
  for (const ObjectId object : slots[first].domain) {
    binding[slots[first].slot] = object;
    for_each_value(slots, binding, visit, first + 1);
  }
  binding[slots[first].slot] = ObjectId();
}

// left OP right
bool compare(pddl::ComparisonOperator op, double left, double right);

double combine(pddl::ArithmeticOperator op, const std::vector<double>& operands);

}  // namespace roci::planner::temporal_pddl
