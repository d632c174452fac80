// This file has the forward and differential kinematics of a serial arm (Siciliano et al., Robotics:
// Modelling, Planning and Control, 2009, sections 2.9 and 3.1).
#pragma once

#include <vector>

#include "core/kinematics/arm.hpp"

namespace roci::kinematics {

/// Holds in rows 0..2 the velocity of the tool's origin, m/s, and in rows 3..5 its angular velocity, rad/s,
/// both in the base frame.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxJoints>;

/// Returns the pose of every body in the base frame, body 0 first. `q` has one value per joint; limits are
/// not looked at.
std::vector<Eigen::Isometry3d> body_poses(const Arm& arm, const JointVector& q);

/// Returns the pose of the tool frame in the base frame.
Eigen::Isometry3d tool_pose(const Arm& arm, const JointVector& q);

/// These take body poses that body_poses() gave.
Eigen::Isometry3d tool_pose(const Arm& arm, const std::vector<Eigen::Isometry3d>& bodies);
Jacobian tool_jacobian(const Arm& arm, const std::vector<Eigen::Isometry3d>& bodies);

/// Returns for each joint an upper bound in m of how far any point of the arm moves per unit of that joint's
/// coordinate, over all coordinates within the limits. A straight joint-space step dq moves no point further
/// than bound·|dq|.
JointVector displacement_bounds(const Arm& arm);

}  // namespace roci::kinematics
