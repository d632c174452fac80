// A warm start makes a first plan out of what remains of an earlier one, which is taken as far as it goes,
// and completed.
#pragma once

#include <optional>
#include <span>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Returns a plan that begins with what can be taken of the remaining steps, in their order; or nothing if
/// within a hundred evaluations nothing complete came of it. Throws what SearchLimits throws.
std::optional<search::PlanPrefix> warm_start(const search::SearchContext& context,
                                             std::span<const task::SnapId> remaining,
                                             const search::Guide& guide);

}  // namespace roci::planner::temporal_pddl::improvement
