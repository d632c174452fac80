// The export of the plan of the engine as the one plan type that all executives run.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/temporal_pddl/extraction/plan.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"

namespace roci::planner::temporal_pddl::extraction {

/// Exports the plan. Activities keep their PDDL action name and, as arguments named "1", "2", …, their
/// objects; conditions compare facts ("(at place-1)" = true) and single fluents ("(battery)" >= 30). Timed
/// literals become windows from the origin, so that every time point left belongs to an activity. Conditions
/// that no single timeline decides are left to the network.
temporal::FlexiblePlan export_plan(const Plan& plan, const std::vector<engine::FunctionUse>& functions);

}  // namespace roci::planner::temporal_pddl::extraction
