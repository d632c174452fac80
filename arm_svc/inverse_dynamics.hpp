// Joint forces of a motion come from the recursive Newton-Euler algorithm (Luh, Walker, Paul, 1980;
// Featherstone, Rigid Body Dynamics Algorithms, 2008, section 5.3), in the axes of the base frame.
#pragma once

#include "arm_svc/trajectory.hpp"
#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Returns what each joint must exert, N·m or N, for `state` under `gravity` (m/s² in the base frame),
/// friction left out.
kinematics::JointVector joint_efforts(const kinematics::Arm& arm, const JointState& state,
                                      const Eigen::Vector3d& gravity);

}  // namespace roci::arm
