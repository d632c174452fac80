// This file bounds where the tool of an arm can be: the proof behind "out of reach".
#pragma once

#include "core/kinematics/arm.hpp"

namespace roci::kinematics {

/// Contains every place of the tool's origin, whatever the joints do within their limits: all points within
/// `radius` of the segment from `from` to `to` (a rail makes it long), in m in the base frame.
struct ReachBound {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  double radius = 0;  ///< sum of the link lengths beyond the first joint that turns, m

  /// Returns by how much a point lies outside, m; 0 within.
  double excess(const Eigen::Vector3d& point) const;
};

ReachBound reach_bound(const Arm& arm);

}  // namespace roci::kinematics
