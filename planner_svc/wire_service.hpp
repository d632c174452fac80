// This file translates planning calls, function values and what engines that plan all the time hear to and
// from their wire form.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/engine/answer.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"
#include "planner_svc/engine/stepped_engine.hpp"
#include "roci_idl/command.h"
#include "roci_idl/function.h"
#include "roci_idl/goal.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"
#include "services/rpc.hpp"

namespace roci::planner {

/// Reads a request; the caller adds budget of wall time and cancellation. At most the first 1,000 remaining
/// actions are taken, and none with a time that a plan cannot have. Throws services::wire::WireError.
engine::Request from_wire(const v1::PlanRequest&);

/// Translates an answer without what only the machine knows: wall time and memory.
v1::PlanReply to_wire(const engine::Answer&);
v1::PlanReply cancelled_reply();

/// Translates `calls` of one function. Arguments that are no objects of the request are added to its objects:
/// they are constants of the domain, which their owner knows by name.
v1::FunctionRequest to_wire(const std::vector<engine::FunctionCall>& calls,
                            const std::vector<engine::Object>& objects);

/// Returns one value for each call, in their order. `asked` says who was asked, by which offer, and when.
std::vector<engine::FunctionValue> values_of(const std::vector<engine::FunctionCall>& calls,
                                             const engine::Provenance& asked,
                                             const services::CallResult<v1::FunctionReply>&);

engine::Goal from_wire(const v1::Goal&);
/// Reads an observation. Throws services::wire::WireError.
engine::Observation from_wire(const v1::Observation&);
/// Reads a data product; one of more than kProductBytes has as many.
engine::DataProduct from_wire(const v1::DataProduct&);
engine::StepStatus from_wire(const v1::StepStatus&);
/// Reads a completed command. Values that are no finite number, or whose names exceed kNameBytes, are left out, and
/// those after the first kResultValues.
engine::CommandResult from_wire(const v1::CommandAck&);
engine::Receipt from_wire(const v1::PlanReceipt&);

}  // namespace roci::planner
