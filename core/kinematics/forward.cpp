#include "core/kinematics/forward.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/shapes.hpp"

namespace roci::kinematics {
namespace {

Eigen::Isometry3d joint_motion(const Joint& joint, double coordinate) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (joint.type == JointType::revolute) {
    motion.linear() = Eigen::AngleAxisd(coordinate, joint.axis).toRotationMatrix();
  } else {
    motion.translation() = coordinate * joint.axis;
  }
  return motion;
}

// Returns the radius about the body's origin within which the body's shapes, its tool and the next joint's
// origin lie.
double body_extent(const Arm& arm, std::size_t body) {
  double extent = 0;
  for (const CollisionShape& shape : arm.bodies[body].shapes) {
    extent = std::max(extent, shape.pose.translation().norm() + bounding_radius(shape));
  }
  if (body == arm.joints.size()) extent = std::max(extent, arm.tool.translation().norm());
  return extent;
}

}  // namespace

std::vector<Eigen::Isometry3d> body_poses(const Arm& arm, const JointVector& q) {
  std::vector<Eigen::Isometry3d> poses(arm.bodies.size());
  poses[0].setIdentity();
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    poses[i + 1] =
        poses[i] * arm.joints[i].origin * joint_motion(arm.joints[i], q[static_cast<Eigen::Index>(i)]);
  }
  return poses;
}

Eigen::Isometry3d tool_pose(const Arm& arm, const JointVector& q) {
  return tool_pose(arm, body_poses(arm, q));
}

Eigen::Isometry3d tool_pose(const Arm& arm, const std::vector<Eigen::Isometry3d>& bodies) {
  return bodies.back() * arm.tool;
}

Jacobian tool_jacobian(const Arm& arm, const std::vector<Eigen::Isometry3d>& bodies) {
  const Eigen::Vector3d tip = tool_pose(arm, bodies).translation();
  Jacobian jacobian(6, static_cast<Eigen::Index>(arm.joints.size()));
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    // A joint's motion leaves its own axis where it is, so the body after the joint gives axis and origin.
    const Eigen::Isometry3d& frame = bodies[i + 1];
    const Eigen::Vector3d axis = frame.linear() * arm.joints[i].axis;
    auto column = jacobian.col(static_cast<Eigen::Index>(i));
    if (arm.joints[i].type == JointType::revolute) {
      column << axis.cross(tip - frame.translation()), axis;
    } else {
      column << axis, Eigen::Vector3d::Zero();
    }
  }
  return jacobian;
}

JointVector displacement_bounds(const Arm& arm) {
  JointVector bounds(static_cast<Eigen::Index>(arm.joints.size()));
  double reach = 0;  // of everything outboard of joint i, from the origin of body i + 1
  for (std::size_t i = arm.joints.size(); i-- > 0;) {
    reach = std::max(reach, body_extent(arm, i + 1));
    const Joint& joint = arm.joints[i];
    const bool turns = joint.type == JointType::revolute;
    bounds[static_cast<Eigen::Index>(i)] = turns ? reach : 1.0;
    const double travel = turns ? 0.0 : std::max(std::abs(joint.limits.lower), std::abs(joint.limits.upper));
    reach += joint.origin.translation().norm() + travel;
  }
  return bounds;
}

}  // namespace roci::kinematics
