// From the search's final steps to the plan that leaves the engine: schedule, network, conditions, effects.
#pragma once

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl {

// steps: a complete plan, temporally consistent. Each time point is scheduled at its earliest time. Of the
// options, epsilon and describe_activities count.
Plan build_plan(const pddl::Domain& domain, const Grounding& grounding, const PlanPrefix& steps,
                const Options& options);

}  // namespace roci::planner::temporal_pddl
