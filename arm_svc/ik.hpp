// Inverse kinematics goes by damped least squares: Levenberg-Marquardt steps whose damping is the remaining
// error (T. Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE
// Trans. on Robotics 27(5), 2011), with joints that stand at a limit frozen, from several deterministic
// starts. A descent ends early that gains next to nothing: another start is the better use of its time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Asks that an axis of the tool frame points along a direction of the base frame; turning about it stays
/// free.
struct Approach {
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();
};

/// Says where the tool frame shall be in the base frame: a position, and at most one of approach and
/// orientation.
struct ToolTarget {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<Approach> approach;
  std::optional<Eigen::Quaterniond> orientation;
};

/// Bounds the search and says when a solution is near enough.
struct IkOptions {
  double position_tolerance = 1e-5;  ///< m
  double angle_tolerance = 1e-4;     ///< rad
  int starts = 48;      ///< While nothing is found, twice as many follow, spread evenly over the limits.
  int iterations = 80;  ///< Bounds each start.
  std::uint64_t seed = 1;
  std::size_t solutions = 1;  ///< The search stops after so many distinct ones.
};

/// Says how far the tool is from its target.
struct ToolError {
  double position = 0;  ///< m
  double angle = 0;     ///< rad; it is 0 where the target leaves orientation free.
};

/// Returns how far the tool is from the target when the joints stand at `q`.
ToolError tool_error(const kinematics::Arm& arm, const kinematics::JointVector& q, const ToolTarget& target);

/// Returns distinct solutions within the joint limits in the order found. If there are none, no start led to
/// one, which is no proof. The first starts are `first_start` (clamped to the limits) and the middle of the
/// limits, the rest are seeded samples, then a Halton sequence.
std::vector<kinematics::JointVector> solve_ik(const kinematics::Arm& arm, const ToolTarget& target,
                                              const kinematics::JointVector& first_start,
                                              const IkOptions& options);

}  // namespace roci::arm
