/// A planner's plan becomes a plan for this mission. That of an engine that reads PDDL names actions, and becomes
/// commands of owners by the mission's metadata; any other one commands by itself and is held against the mission.
#pragma once

#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::reactor {

/// Gives each activity an id that no other plan of the run has (and every reference to it). An activity of a PDDL
/// plan gets its command; its arguments are its PDDL objects in order, and conditions that
/// no observation can decide are left out (their times stand in the network). One that commands itself keeps what
/// it says, but for arguments that are a property of an object of the problem ("w1.x"), which get its value; its
/// subsystems get this executive's robot where it names none. Returns what is wrong, empty if nothing: an action
/// without binding, a property that its object has not, an owner or subsystem that the mission has not.
std::string bind_plan(temporal::FlexiblePlan& plan, std::uint32_t version,
                      const mission::MissionModel& mission, const problem::Problem& problem,
                      const beliefs::Beliefs& beliefs);

}  // namespace roci::exec::reactor
