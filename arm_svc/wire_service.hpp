// This file translates between the wire and the arm model, without a node.
#pragma once

#include <set>
#include <stop_token>
#include <string>

#include "arm_svc/estimate.hpp"
#include "roci_idl/function.h"
#include "roci_idl/motion.h"

namespace roci::arm {

inline constexpr const char* kModule = "arm";

/// Returns what module `arm` offers: arm_move_time [s] and arm_move_energy [J] of (from, to).
v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t model_version);

/// Holds the reply, and what is worth an event.
struct FunctionAnswer {
  v1::FunctionReply reply;
  std::set<std::string> refusals;  ///< say in words why tuples have no value
};

/// Gives every tuple an outcome. An object with properties q0, q1, … (finite numbers, one per joint) is where
/// these joint values put the arm, any other a named pose of the mission. Once stopped, the remaining tuples
/// fail.
FunctionAnswer evaluate(EstimateCache& cache, const MotionModel& model, const v1::FunctionRequest& request,
                        const std::stop_token& stop);

/// Finds a motion. The trajectory is sampled at most 0.1 s apart; one that goes nowhere has a single sample.
v1::ArmMotionReply find_motion(const MotionModel& model, const v1::ArmMotionRequest& request,
                               const std::stop_token& stop);

}  // namespace roci::arm
