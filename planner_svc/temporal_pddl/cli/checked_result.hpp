// No plan is printed that the validator refuses.
#pragma once

#include <string>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/result.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Has the validator execute the plan as it would be printed. If that refuses it, which is a defect of the
/// planner, the result loses its plan, its verdict is `crashed` and its reason what the validator said.
/// Returns the text to be printed; it is empty without a plan.
std::string check(const pddl::Domain& domain, const pddl::Problem& problem, Result& result);

}  // namespace roci::planner::temporal_pddl::cli
