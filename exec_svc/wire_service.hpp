// This file translates the reactor's inputs and outputs to and from their wire form.
#pragma once

#include "exec_svc/reactor/reactor.hpp"
#include "roci_idl/command.h"
#include "roci_idl/executed.h"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"

namespace roci::exec {

goals::GoalRequest from_wire(const v1::Goal&);
executive::Observation from_wire(const v1::Observation&);
executive::CommandAck from_wire(const v1::CommandAck&);
reactor::PlanReply from_wire(std::uint64_t call, const v1::PlanReply&);

v1::Goal to_wire(const goals::GoalRequest&);
v1::GoalStatus to_wire(const goals::GoalRecord&, const std::string& executive, goals::AckStage);
/// Translates a command. `epoch` is the commander's now; the key holds that of issue (Command::epoch).
v1::Command to_wire(const executive::Command&, const std::string& commander, std::uint32_t plan_version,
                    std::uint64_t epoch);
v1::StepStatus to_wire(const executive::StepStatus&, const std::string& executive,
                       std::uint32_t plan_version);
v1::ExecutedPlan to_wire(const reactor::ExecutedPlan&, const std::string& executive);
v1::PlanRequest to_wire(const reactor::PlanRequest&, const mission::MissionModel&);
v1::PlanReceipt to_wire(const reactor::PlanReceipt&, const std::string& executive);
v1::Event to_wire(const reactor::Event&);

/// Return the trace line of what was seen; journal/decisions.hpp has those of what was decided. Nothing in
/// them depends on the machine.
std::string trace_line(const v1::CommandAck&);
std::string trace_line(const v1::Observation&);

}  // namespace roci::exec
