// This file translates between the world's plain values and the wire.
#pragma once

#include <string>
#include <vector>

#include "roci_idl/command.h"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/map.h"
#include "roci_idl/motion.h"
#include "roci_idl/network.h"
#include "roci_idl/order.h"
#include "roci_idl/outlook.h"
#include "services/owner/command.hpp"
#include "sim_svc/scenario/scenario.hpp"
#include "sim_svc/world/world.hpp"

namespace roci::sim::wire {

/// Translate what comes in.
world::TaskKey task_key(const services::owner::CommandKey&);
services::owner::CommandKey command_key(const world::TaskKey&);
world::Order order_of(const services::owner::Request&);
/// Returns the owner's word on a task; a report of a repair is none (CommandServer::repair).
services::owner::CommandStatus status_of(const world::TaskReport&);
world::Way way_of(const v1::PathReply&);
world::DownlinkSchedule schedule_of(const v1::DownlinkSchedule&);
world::Trajectory trajectory_of(const v1::ArmMotionReply&);

/// Translate what goes out.
v1::Observation to_wire(const world::Observed&);
v1::DataProduct to_wire(const world::Image&);
v1::DataProduct to_wire(const world::Product&);
v1::Hazard to_wire(const world::RockSeen&, const std::string& finder);
v1::Hazard to_wire(const world::SoilMarked&, const std::string& finder);
/// Translates a finding for the map of the robot that has found it.
v1::TerrainFinding finding_of(const world::RockSeen&);
v1::TerrainFinding finding_of(const world::SoilMarked&);
v1::PathRequest to_wire(const world::PathWanted&);
v1::ArmMotionRequest to_wire(const world::MotionWanted&);
v1::Goal to_wire(const scenario::GoalStimulus&, bool recalled);
/// Sends the content as it is in the file, damaged or not.
v1::NetworkOrder to_wire(const scenario::NetworkStimulus&);
v1::Order to_wire(const scenario::OrderStimulus&);
v1::Event event(v1::Severity, const std::string& code, const std::string& text);

}  // namespace roci::sim::wire
