// From a first plan to better ones, within a stated amount of work.
#pragma once

#include <span>

#include "planner_svc/temporal_pddl/improvement/fresh_starts.hpp"
#include "planner_svc/temporal_pddl/improvement/weighted_search.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// The given plan without useless actions, or a better one. The guides take turns, and fresh starts with them.
// Options::improvement_evaluations bounds the work. A spent budget ends it with the best plan so far; throws
// Refusal (cancelled) only.
PlanPrefix improve(const Task& task, PlanPrefix first, std::span<const Guide> guides,
                   FreshStarts& fresh_starts, const Options& options, Watch& watch, Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
