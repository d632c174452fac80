// Prints a plan in the form of the planning competitions: "0.001: (drive a b) [12.500]", one line per
// activity.
#pragma once

#include <string>

#include "planner_svc/temporal_pddl/extraction/plan.hpp"

namespace roci::planner::temporal_pddl::extraction {

std::string to_ipc(const Plan& plan);

}  // namespace roci::planner::temporal_pddl::extraction
