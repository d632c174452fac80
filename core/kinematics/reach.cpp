#include "core/kinematics/reach.hpp"

#include <algorithm>
#include <cmath>

namespace roci::kinematics {

double ReachBound::excess(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d way = to - from;
  const double square = way.squaredNorm();
  const double along = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
  return std::max(0.0, (point - (from + along * way)).norm() - radius);
}

ReachBound reach_bound(const Arm& arm) {
  ReachBound bound;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  bool turned = false;
  Eigen::Vector3d slide = Eigen::Vector3d::Zero();  // of the rail, from its lower to its upper limit
  Eigen::Vector3d slid = Eigen::Vector3d::Zero();   // at its lower limit
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const Joint& joint = arm.joints[i];
    // What lies before the first joint that turns moves with the rail alone, as a stiff whole.
    if (turned) bound.radius += joint.origin.translation().norm();
    frame = frame * joint.origin;
    if (joint.type == JointType::revolute) {
      if (!turned) bound.from = frame.translation() + slid;
      turned = true;
      continue;
    }
    if (!turned && i == 0) {
      const Eigen::Vector3d axis = frame.linear() * joint.axis;
      slid = joint.limits.lower * axis;
      slide = (joint.limits.upper - joint.limits.lower) * axis;
    } else {
      bound.radius += std::max(std::abs(joint.limits.lower), std::abs(joint.limits.upper));
    }
  }
  if (turned) {
    bound.radius += arm.tool.translation().norm();
  } else {
    bound.from = (frame * arm.tool).translation() + slid;
  }
  bound.to = bound.from + slide;
  return bound;
}

}  // namespace roci::kinematics
