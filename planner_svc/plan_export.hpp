// An engine's result as the one plan type that all executives run.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner {

// Activities keep their PDDL action name and, as arguments named "1", "2", …, their objects; conditions
// compare facts
// ("(at place-1)" = true) and single fluents ("(battery)" >= 30). Timed literals become windows from the
// origin, so that every time point left belongs to an activity. Conditions that no single timeline decides
// are left to the network.
temporal::FlexiblePlan export_plan(const temporal_pddl::Plan& plan,
                                   const std::vector<temporal_pddl::FunctionUse>& functions);

}  // namespace roci::planner
