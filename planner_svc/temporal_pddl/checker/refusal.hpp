// The validator's word on a plan as text, for whoever gives it out without the seam of planner_svc.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"

namespace roci::planner::temporal_pddl::checker {

/// Returns what the validator says against the steps as a plan of the problem, one line for each thing that
/// they break; empty if it says nothing. `functions` has the values of external functions.
std::string refusal(const pddl::Domain& domain, const pddl::Problem& problem,
                    const std::vector<pddl::PlanStep>& steps, const pddl::FunctionTable& functions);

}  // namespace roci::planner::temporal_pddl::checker
