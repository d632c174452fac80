// Constant functions are those that no action and no timed literal changes: constant fluents and external
// functions (R35).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Knows the value of each constant function on each tuple.
class ConstantFunctions {
 public:
  /// Takes the fluents that are constant in this model, with their initial values.
  ConstantFunctions(const pddl::Problem& problem, const std::vector<LiftedAction>& actions,
                    const Symbols& symbols);

  /// Asks `source` for all external functions on all typed tuples, one batch per function (R37), and appends
  /// every tuple with its answer to `used`, if that is wanted. Throws ModelFailure (function_unavailable), naming
  /// function and tuple, if an answer is neither a value nor "unreachable" nor "unknown",
  /// and PlanningFailure (cancelled).
  void load_external(engine::FunctionSource& source, const std::function<bool()>& cancelled,
                     const Symbols& symbols, std::vector<engine::FunctionUse>* used);

  bool is_constant(task::FunctionId function) const { return constant_[function]; }
  /// Returns nothing if the constant is undefined, unreachable or unknown there, so that no action instance
  /// can use it.
  std::optional<double> value(task::FunctionId function, std::span<const task::ObjectId> objects) const;
  /// Returns a tuple without a value that was asked for, if there was one; never one of an external function.
  const std::optional<std::vector<task::ObjectId>>& missed(task::FunctionId function) const {
    return missed_[function];
  }

 private:
  void define(task::FunctionId function, std::span<const task::ObjectId> objects, double value);

  task::IdVector<task::FunctionId, bool> constant_;
  TupleTable tuples_;
  std::vector<double> values_;
  task::IdVector<task::FunctionId, bool> external_;
  mutable task::IdVector<task::FunctionId, std::optional<std::vector<task::ObjectId>>> missed_;
};

}  // namespace roci::planner::temporal_pddl::grounding::lifted
