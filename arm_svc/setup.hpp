// The setup is everything that the arm service plans with, as mission data says it, in one plain value.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "arm_svc/collision.hpp"
#include "arm_svc/energy.hpp"
#include "arm_svc/ik.hpp"
#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Is a place of the arm that plans may name.
struct NamedPose {
  std::string name;
  std::variant<kinematics::JointVector, ToolTarget> where;
};

/// Holds all that motions depend on.
struct ArmSetup {
  kinematics::Arm arm;
  std::vector<NamedPose> poses;  ///< Their names are unique.
  CollisionRules collision;
  MotorModel motor;
  unsigned search_iterations = 2000;
  int shortcut_trials = 60;
};

/// Returns a number that changes when any value changes that a motion or an estimate depends on: the arm's
/// model version.
std::uint64_t model_version(const ArmSetup& setup);

}  // namespace roci::arm
