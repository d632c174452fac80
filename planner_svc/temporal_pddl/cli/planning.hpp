// One call of the planner as the command line asks for it.
#pragma once

#include <functional>

#include "planner_svc/temporal_pddl/cli/arguments.hpp"
#include "planner_svc/temporal_pddl/cli/read_model.hpp"
#include "planner_svc/temporal_pddl/result.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Plans until a limit of the arguments is met, `out_of_time` says so, or `interrupted` does. Tells on standard error
/// what goes on where the arguments or a terminal ask for that. Throws ParseError for a table of functions or a
/// remaining plan that cannot be read. The plan is not checked.
Result plan(const Arguments& arguments, const Model& model, const std::function<bool()>& out_of_time,
            const std::function<bool()>& interrupted);

}  // namespace roci::planner::temporal_pddl::cli
