// The improvement leads from a first plan to better ones, within a stated amount of work.
#pragma once

#include <span>

#include "planner_svc/temporal_pddl/improvement/restarts.hpp"
#include "planner_svc/temporal_pddl/improvement/weighted_a_star.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Returns the given plan without useless actions, or a better one. The guides take turns, and restarts with
/// them. Options::improvement_evaluations bounds the work. A spent budget ends it with the best plan so far;
/// it throws PlanningFailure (cancelled) only.
search::PlanPrefix improve(search::PlanPrefix first, std::span<const search::Guide> guides,
                           Restarts& restarts, const search::SearchContext& context);

}  // namespace roci::planner::temporal_pddl::improvement
