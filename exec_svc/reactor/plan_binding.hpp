// Plan binding turns a planner's plan into one for this mission. A plan of an engine that reads PDDL names
// actions, which become commands of owners by the mission's metadata; any other plan commands by itself and is
// checked against the mission.
#pragma once

#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::reactor {

/// Gives each activity an id that no other plan of the run has, and updates every reference to it. An activity of
/// a PDDL plan gets its command; its arguments are its PDDL objects in order, and conditions that no observation
/// can decide are left out (their times stand in the network). An activity that commands by itself stays as it
/// is, except that arguments naming a property of an object of the problem ("w1.x") get its value, and subsystems
/// without a robot get this executive's. Returns what is wrong, empty if nothing: an action without binding, a
/// property that its object lacks, an owner or subsystem that the mission lacks.
std::string bind_plan(temporal::FlexiblePlan& plan, std::uint32_t version,
                      const mission::MissionModel& mission, const problem::Problem& problem,
                      const beliefs::Beliefs& beliefs);

}  // namespace roci::exec::reactor
