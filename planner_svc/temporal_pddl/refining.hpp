// A planning call that asks owners of external functions for few exact values (R39): it plans on cheap ones,
// asks exactly for what the plan stands on, and plans again until the plan stands on exact values alone.
//
// In mode two_accuracy the cheap values are the owners' lower bounds, and this is the lazy evaluation of
// Dellin and Srinivasa (2016, "A unifying formalism for shortest path problems with expensive edge evaluations
// via lazy best-first search over paths with edge selectors"): if searches are exhaustive and no bound is
// above its value, the last plan is optimal, as every other plan costs at least what it cost with bounds. In
// mode lazy a value that nobody has asked for counts as the smallest one known, and all values that the
// search touches are asked for after each search.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/result.hpp"
#include "planner_svc/temporal_pddl/values/action_tuples.hpp"

namespace roci::planner::temporal_pddl {

/// One search from grounding to plan, on the values that `functions` gives.
struct Attempt {
  engine::FunctionSource& functions;
  call::Budget budget;
  call::Options options;
  std::span<const pddl::PlanStep> remaining;
  /// Gets every action instance whose facts hold in a state that a search expands; null: nobody asks.
  std::vector<values::ActionInstance>* touched = nullptr;
  bool keeps_functions = true;  ///< false: the result names no function values
};

using MakeAttempt = std::function<Result(const Attempt&)>;

/// Describes a whole call of the engine, but for what it refines.
struct RefinedCall {
  const pddl::Domain& domain;
  const pddl::Problem& problem;
  engine::FunctionSource& functions;
  const call::Budget& budget;
  const call::Monitor& monitor;
  const call::Options& options;
  std::span<const pddl::PlanStep> remaining;
};

/// Plans in the mode that the options name, which is not eager. A plan stands on exact values alone, and so
/// does the verdict `unsolvable`: before it is given, everything is asked for exactly. Ends, as each round
/// makes at least one value exact. Until a plan stands on exact values, the budget of evaluations counts what
/// each round takes up to its first plan, and each may spend that of better plans beside. Throws ModelFailure.
Result plan_refining(const RefinedCall& call, const MakeAttempt& attempt);

}  // namespace roci::planner::temporal_pddl
