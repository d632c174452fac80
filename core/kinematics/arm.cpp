#include "core/kinematics/arm.hpp"

#include <algorithm>

namespace roci::kinematics {

bool within_limits(const Arm& arm, const JointVector& q, double tolerance) {
  if (q.size() != static_cast<Eigen::Index>(arm.joints.size())) return false;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimits& limits = arm.joints[i].limits;
    const bool inside = q[i] >= limits.lower - tolerance && q[i] <= limits.upper + tolerance;
    if (!inside) return false;
  }
  return true;
}

JointVector clamp_to_limits(const Arm& arm, const JointVector& q) {
  JointVector clamped = q;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimits& limits = arm.joints[i].limits;
    clamped[i] = std::clamp(q[i], limits.lower, limits.upper);
  }
  return clamped;
}

}  // namespace roci::kinematics
