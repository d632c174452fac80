// The validator's word on a plan as text, for whoever gives it out without the seam of planner_svc.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::checker {

/// The answers as the table that the validator reads; a tuple without a value stands in it as unreachable.
pddl::FunctionTable table_of(std::span<const engine::FunctionUse> uses);

/// Returns what the validator says against the steps as a plan of the problem, one line for each thing that
/// they break; empty if it says nothing. `functions` has the answers of external functions.
std::string refusal(const pddl::Domain& domain, const pddl::Problem& problem,
                    const std::vector<pddl::PlanStep>& steps, std::span<const engine::FunctionUse> functions);

}  // namespace roci::planner::temporal_pddl::checker
