// This file translates between the wire and the arm model, without a node.
#pragma once

#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "arm_svc/estimate.hpp"
#include "arm_svc/functions.hpp"
#include "roci_idl/function.h"
#include "roci_idl/motion.h"
#include "services/wire/function_wire.hpp"

namespace roci::arm {

/// Returns the module's functions as they are offered: with types and units [s, J], exact and as a lower bound.
std::vector<services::wire::OwnedFunction> owned_functions(const ArmModule& module);

v1::FunctionOffer function_offer(const ArmModule& module, const std::string& owner,
                                 std::uint64_t model_version);

/// Holds the reply, and what is worth an event.
struct FunctionAnswer {
  v1::FunctionReply reply;
  std::set<std::string> refusals;  ///< say in words why tuples have no value
};

/// Gives every tuple an outcome. An object with properties q0, q1, … (finite numbers, one per joint) is where
/// these joint values put the arm, else it is the named pose of the mission, else where x, y and z (m) put the
/// tool. UNREACHABLE is proved; where the search or the inverse kinematics found nothing the outcome is UNKNOWN,
/// and the next request spends twice the effort. Once stopped, the remaining tuples fail.
FunctionAnswer evaluate(EstimateCache& cache, const MotionModel& model, const ArmModule& module,
                        const v1::FunctionRequest& request, const std::stop_token& stop);

/// Finds a motion, with kMostEffort from the start. The trajectory is sampled at most 0.1 s apart; one that goes
/// nowhere has a single sample.
v1::ArmMotionReply find_motion(const MotionModel& model, const v1::ArmMotionRequest& request,
                               const std::stop_token& stop);

}  // namespace roci::arm
