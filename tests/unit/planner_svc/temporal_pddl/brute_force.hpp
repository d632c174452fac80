// Is there a plan with at most so many actions? Found out on the syntax tree, by trying all orders of
// happenings.
//
// Shares nothing with the engine but the reading of PDDL: states are sets of names, times a matrix of
// all-pairs bounds. Only for tasks as random_task() makes them.
#pragma once

#include <optional>

#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::testing {

bool has_plan(const Model& model, std::size_t max_actions);
// The shortest makespan of such plans; none: there are none.
std::optional<temporal::Duration> best_makespan(const Model& model, std::size_t max_actions);

}  // namespace roci::planner::temporal_pddl::testing
