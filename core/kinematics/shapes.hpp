// This file measures collision shapes.
#pragma once

#include "core/kinematics/arm.hpp"

namespace roci::kinematics {

/// Returns the radius in m of the smallest sphere about the shape's own origin that contains it.
double bounding_radius(const CollisionShape& shape);

/// Returns the shape with its surface moved outwards by `margin` m (a box grows by the margin on each side).
CollisionShape inflated(const CollisionShape& shape, double margin);

}  // namespace roci::kinematics
