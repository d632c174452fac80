// From the search's final steps to the plan that leaves the engine: schedule, network, conditions, effects.
#pragma once

#include <span>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/call/named_goal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan.hpp"
#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl::extraction {

/// Builds the plan from its steps, which are complete and temporally consistent. Each time point is
/// scheduled at its earliest time. Of the options, epsilon and describe_activities count. Activities say
/// which of `goals` they serve.
Plan build_plan(const pddl::Domain& domain, const grounding::Grounding& grounding,
                const search::PlanPrefix& steps, const call::Options& options,
                std::span<const call::NamedGoal> goals);

}  // namespace roci::planner::temporal_pddl::extraction
