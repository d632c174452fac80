#include "arm_svc/inverse_dynamics.hpp"

#include <array>

#include "core/kinematics/forward.hpp"

namespace roci::arm {
namespace {

using Eigen::Vector3d;
using kinematics::JointType;
using kinematics::JointVector;

// Holds the motion of a body's frame, all in base axes; the linear acceleration is that of the frame's
// origin, less gravity.
struct BodyMotion {
  Vector3d turn_rate = Vector3d::Zero();
  Vector3d turn_acceleration = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();

  Vector3d acceleration_at(const Vector3d& offset) const {
    return acceleration + turn_acceleration.cross(offset) + turn_rate.cross(turn_rate.cross(offset));
  }
};

struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();  // about the body's origin
};

BodyMotion moved_by(const BodyMotion& previous, JointType type, const Vector3d& axis, const Vector3d& offset,
                    double rate, double acceleration) {
  BodyMotion motion = previous;
  motion.acceleration = previous.acceleration_at(offset);
  if (type == JointType::revolute) {
    motion.turn_rate += rate * axis;
    motion.turn_acceleration += acceleration * axis + rate * previous.turn_rate.cross(axis);
  } else {
    motion.acceleration += acceleration * axis + 2.0 * rate * previous.turn_rate.cross(axis);
  }
  return motion;
}

// Returns the force and moment that make the body move as it does.
Wrench wrench_of(const kinematics::MassProperties& mass, const Eigen::Isometry3d& pose,
                 const BodyMotion& motion) {
  const Vector3d centre = pose.linear() * mass.centre;
  const Eigen::Matrix3d inertia = pose.linear() * mass.inertia * pose.linear().transpose();
  const Vector3d force = mass.mass * motion.acceleration_at(centre);
  const Vector3d momentum = inertia * motion.turn_rate;
  return {force, inertia * motion.turn_acceleration + motion.turn_rate.cross(momentum) + centre.cross(force)};
}

}  // namespace

JointVector joint_efforts(const kinematics::Arm& arm, const JointState& state,
                          const Eigen::Vector3d& gravity) {
  const auto poses = kinematics::body_poses(arm, state.position);
  const std::size_t joints = arm.joints.size();
  std::array<Vector3d, kinematics::kMaxJoints> axes;
  std::array<Wrench, kinematics::kMaxJoints> wrenches;

  BodyMotion motion;
  motion.acceleration = -gravity;
  for (std::size_t i = 0; i < joints; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    axes[i] = poses[i + 1].linear() * arm.joints[i].axis;
    const Vector3d offset = poses[i + 1].translation() - poses[i].translation();
    motion =
        moved_by(motion, arm.joints[i].type, axes[i], offset, state.velocity[row], state.acceleration[row]);
    wrenches[i] = wrench_of(arm.bodies[i + 1].mass, poses[i + 1], motion);
  }

  JointVector efforts(static_cast<Eigen::Index>(joints));
  Wrench outboard;
  for (std::size_t i = joints; i-- > 0;) {
    if (i + 1 < joints) {
      const Vector3d offset = poses[i + 2].translation() - poses[i + 1].translation();
      outboard.moment += offset.cross(outboard.force);
    }
    outboard.force += wrenches[i].force;
    outboard.moment += wrenches[i].moment;
    const bool turns = arm.joints[i].type == JointType::revolute;
    efforts[static_cast<Eigen::Index>(i)] = axes[i].dot(turns ? outboard.moment : outboard.force);
  }
  return efforts;
}

}  // namespace roci::arm
