// The way from a checked model to the ground task.
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/function_source.hpp"
#include "planner_svc/temporal_pddl/grounding/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/symbols.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

struct Grounding {
  Symbols symbols;
  ConstantFunctions constants;
  Task task;
};

// Throws Refusal: unsupported with the place in the model; unsolvable naming the goal that nothing can
// reach; function_unavailable; and what Watch throws. `used` gets every external value, whatever happens.
Grounding ground(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
                 const Options& options, Watch& watch, std::vector<FunctionUse>& used);

}  // namespace roci::planner::temporal_pddl
