// Action elimination (Nakhost and Müller 2010) on temporal plans leaves out what serves nothing: each action
// in turn is dropped with all that cannot start without it; if goals, durations and the temporal network
// still hold and the plan got no worse, it stays out.
#pragma once

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_quality.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_replay.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Bounds its work by the number of steps taken again: about max_steps.
void eliminate_useless_actions(const task::Task& task, search::PlanPrefix& plan, PlanReplay& replay,
                               std::size_t max_steps, call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::improvement
