// A planning call and its function values in their wire form.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/adapter/planning_call.hpp"
#include "roci_idl/function.h"
#include "roci_idl/planner.h"
#include "services/rpc.hpp"

namespace roci::planner {

/// Budget of wall time and cancellation are the caller's to add. Of more than 1,000 remaining actions the
/// first are taken, and none with a time that a plan cannot have.
temporal_pddl::adapter::PlanningCall from_wire(const v1::PlanRequest&);

/// Without what only the machine knows: wall time and memory.
v1::PlanReply to_wire(const temporal_pddl::adapter::PlanningAnswer&);
v1::PlanReply cancelled_reply();

/// `calls`: of one function. Arguments that are no objects of the request are added to them: constants of the
/// domain, which their owner knows by name.
v1::FunctionRequest to_wire(const std::vector<FunctionCall>& calls, std::vector<v1::PlanObject> objects);

/// One value for each call, in their order. `asked`: who was asked, by which offer, when.
std::vector<FunctionValue> values_of(const std::vector<FunctionCall>& calls, const Provenance& asked,
                                     const services::CallResult<v1::FunctionReply>&);

}  // namespace roci::planner
