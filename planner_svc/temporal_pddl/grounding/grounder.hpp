// The grounder leads from a checked model to the ground task.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Holds what grounding gives: the task, and the names and constants of the model for reports.
struct Grounding {
  lifted::Symbols symbols;
  lifted::ConstantFunctions constants;
  task::Task task;
};

/// Holds what grounding has to tell beside its result; it is filled in whatever happens.
struct GroundingReport {
  std::vector<engine::FunctionUse> functions;  ///< every external value that was asked for
  bool keeps_functions = true;                 ///< false: nobody wants them, they are many
  /// "FILE:LINE:COLUMN: warning: …", one for each number that has no value though something reads it.
  std::vector<std::string> warnings;
  std::size_t shorter_than_separation = 0;  ///< action instances, see impossible_actions.hpp
};

/// Grounds the model. Throws PlanningFailure
/// (`unsupported` with the place in the model, `unsolvable` with the goal that nothing can reach,
/// `function_unavailable`), and what SearchLimits throws.
Grounding ground(const pddl::Domain& domain, const pddl::Problem& problem, engine::FunctionSource& functions,
                 const call::Options& options, call::SearchLimits& limits, GroundingReport& report);

}  // namespace roci::planner::temporal_pddl::grounding
