// The functions that no action and no timed literal changes: constant fluents and external functions (R35).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/function_source.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/tuple_table.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

class ConstantFunctions {
 public:
  // The fluents that are constant in this model, with their initial values.
  ConstantFunctions(const pddl::Problem& problem, const std::vector<LiftedAction>& actions,
                    const Symbols& symbols);

  // Asks `source` for all external functions on all typed tuples, one batch per function (R37), and appends
  // every tuple with its answer to `used`. Throws Refusal: function_unavailable, naming function and tuple,
  // if an answer is neither a value nor "unreachable"; cancelled.
  void load_external(FunctionSource& source, const std::function<bool()>& cancelled, const Symbols& symbols,
                     std::vector<FunctionUse>& used);

  bool is_constant(FunctionId function) const { return constant_[function]; }
  // None: the constant is undefined or unreachable there, so that no action instance can use it.
  std::optional<double> value(FunctionId function, std::span<const ObjectId> objects) const;

 private:
  void define(FunctionId function, std::span<const ObjectId> objects, double value);

  IdVector<FunctionId, bool> constant_;
  TupleTable tuples_;
  std::vector<double> values_;
};

}  // namespace roci::planner::temporal_pddl
