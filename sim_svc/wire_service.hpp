// Between the world's plain values and the wire.
#pragma once

#include <string>
#include <vector>

#include "roci_idl/command.h"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/motion.h"
#include "sim_svc/scenario.hpp"
#include "sim_svc/world.hpp"

namespace roci::sim::wire {

Request from_wire(const v1::Command&);
std::vector<terrain::Point> way_of(const v1::PathReply&);
std::vector<JointTarget> trajectory_of(const v1::ArmMotionReply&);

v1::CommandAck to_wire(const Ack&, const std::string& owner);
v1::Observation to_wire(const Observed&);
v1::DataProduct to_wire(const Image&);
v1::Hazard to_wire(const RockSeen&, const std::string& finder);
v1::PathRequest to_wire(const PathWanted&);
v1::ArmMotionRequest to_wire(const MotionWanted&);
v1::Goal to_wire(const GoalStimulus&, bool recalled);
v1::Event event(v1::Severity, const std::string& code, const std::string& text);

}  // namespace roci::sim::wire
