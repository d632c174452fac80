// Leaves out of a plan what serves nothing: greedy action elimination (Nakhost and Müller 2010) on temporal
// plans. Each action in turn is dropped with all that cannot start without it; if goals, durations and the
// temporal network still hold and the plan got no worse, it stays out.
#pragma once

#include "planner_svc/temporal_pddl/improvement/quality.hpp"
#include "planner_svc/temporal_pddl/improvement/replay.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// The work is bounded by the number of steps taken again: about max_steps.
void drop_useless_actions(const Task& task, PlanPrefix& plan, Replay& replay, std::size_t max_steps,
                          Watch& watch);

}  // namespace roci::planner::temporal_pddl
