// This file joins the mass properties of rigidly joined parts.
#pragma once

#include "core/kinematics/arm.hpp"

namespace roci::kinematics {

/// Expresses `part`, given in a frame whose pose in the wanted frame is `pose`, in the wanted frame.
MassProperties moved(const MassProperties& part, const Eigen::Isometry3d& pose);

/// Joins two parts of the same frame into one (parallel-axis theorem). Massless parts add nothing.
MassProperties joined(const MassProperties& a, const MassProperties& b);

}  // namespace roci::kinematics
