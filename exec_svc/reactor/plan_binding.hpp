/// A planner's plan becomes a plan for this mission: actions become commands of owners, by the mission's
/// metadata.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/problem/problem_writer.hpp"

namespace roci::exec::reactor {

/// Gives each activity an id that no other plan of the run has, its command, and the goals it serves; leaves
/// out conditions that no observation can decide (their times stand in the network). An activity's arguments
/// are its PDDL objects in order. Returns what is wrong, empty if nothing: an action without binding, a
/// property that its object has not.
std::string bind_plan(temporal::FlexiblePlan& plan, std::uint32_t version,
                      const mission::MissionModel& mission, const problem::Problem& problem,
                      const beliefs::Beliefs& beliefs, const goals::GoalSet& goals);

}  // namespace roci::exec::reactor
