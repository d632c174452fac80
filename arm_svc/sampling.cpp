#include "arm_svc/sampling.hpp"

#include "arm_svc/fingerprint.hpp"

namespace roci::arm {

kinematics::JointVector sample_coordinates(const kinematics::Arm& arm, std::mt19937_64& rng) {
  kinematics::JointVector q(static_cast<Eigen::Index>(arm.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const kinematics::JointLimits& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    q[i] = limits.lower + (limits.upper - limits.lower) * unit_sample(rng);
  }
  return q;
}

std::uint64_t query_seed(const kinematics::JointVector& from, const kinematics::JointVector& to) {
  return Fingerprint().add(from).add(to).value();
}

}  // namespace roci::arm
