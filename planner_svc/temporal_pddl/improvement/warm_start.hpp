// A first plan out of what remains of an earlier one: it is taken as far as it goes, and completed.
#pragma once

#include <optional>
#include <span>

#include "core/pddl/plan_text.hpp"
#include "planner_svc/temporal_pddl/improvement/weighted_search.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// Of the remaining steps only their order in time counts; what the task does not know or cannot take is
// passed over. None: within a hundred evaluations nothing complete came of it. Throws what Watch throws.
std::optional<PlanPrefix> warm_start(const Task& task, std::span<const pddl::PlanStep> remaining,
                                     const Guide& guide, const Options& options, Watch& watch,
                                     Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
