// Random arms and joint vectors for property tests.
#pragma once

#include <random>

#include "core/kinematics/arm.hpp"

namespace roci::kinematics::test {

inline double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

inline Eigen::Vector3d random_vector(std::mt19937_64& rng, double size) {
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

inline Eigen::Isometry3d random_pose(std::mt19937_64& rng, double size) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis = (random_vector(rng, 1.0) + Eigen::Vector3d(0, 0, 1e-3)).normalized();
  pose.linear() = Eigen::AngleAxisd(uniform(rng, -3.1, 3.1), axis).toRotationMatrix();
  pose.translation() = random_vector(rng, size);
  return pose;
}

// 4 to 7 joints with any axes; about one joint in five is prismatic.
inline Arm random_arm(std::mt19937_64& rng) {
  Arm arm;
  const int joints = std::uniform_int_distribution<int>(kMinJoints, kMaxJoints)(rng);
  arm.bodies.resize(static_cast<std::size_t>(joints) + 1);
  for (int i = 0; i < joints; ++i) {
    Joint joint;
    joint.type = uniform(rng, 0, 1) < 0.2 ? JointType::prismatic : JointType::revolute;
    joint.origin = random_pose(rng, 0.4);
    joint.axis = (random_vector(rng, 1.0) + Eigen::Vector3d(0, 0, 1e-3)).normalized();
    joint.limits = {-uniform(rng, 0.2, 3.0), uniform(rng, 0.2, 3.0), 1.0, 2.0, 10.0};
    arm.joints.push_back(joint);
    arm.bodies[static_cast<std::size_t>(i) + 1].shapes.push_back(
        {"link", random_pose(rng, 0.2), Capsule{uniform(rng, 0.01, 0.1), uniform(rng, 0.1, 0.4)}});
  }
  arm.tool = random_pose(rng, 0.3);
  return arm;
}

inline JointVector random_coordinates(std::mt19937_64& rng, const Arm& arm) {
  JointVector q(static_cast<Eigen::Index>(arm.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimits& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    q[i] = uniform(rng, limits.lower, limits.upper);
  }
  return q;
}

}  // namespace roci::kinematics::test
