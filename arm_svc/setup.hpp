// The setup is everything that the arm service plans with, as mission data says it, in one plain value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arm_svc/collision.hpp"
#include "arm_svc/energy.hpp"
#include "arm_svc/ik.hpp"
#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Describes a place of the arm that plans may name.
struct NamedPose {
  std::string name;
  std::variant<kinematics::JointVector, ToolTarget> where;
  /// Holds the edges (m, along the base axes) of the module that the tool grasps here: a box beyond the tool
  /// along its axis. It is taken as standing there in every motion but those that start or end at this pose.
  std::optional<Eigen::Vector3d> module_size = std::nullopt;
  std::string source = {};  ///< Says where it was read ("file:line:column").
};

/// Holds all that motions depend on.
struct ArmSetup {
  kinematics::Arm arm;
  std::vector<NamedPose> poses;  ///< Their names are unique.
  CollisionRules collision;
  MotorModel motor;
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitX();  ///< A load is held along it, in the tool frame.
  unsigned search_iterations = 2000;
  int shortcut_trials = 60;
};

/// Returns a number that changes when any value changes that a motion or an estimate depends on: the arm's
/// model version.
std::uint64_t model_version(const ArmSetup& setup);

}  // namespace roci::arm
