// Shortcuts smooth a path (Geraerts, Overmars, "Creating high-quality paths for motion planning", IJRR 26(8),
// 2007): a straight line between two points of the path replaces what lies between them if it is free and
// faster.
#pragma once

#include <cstdint>

#include "arm_svc/path_search.hpp"

namespace roci::arm {

/// Returns a path with the same ends that is never slower than `path`, and free of contact if `path` is.
/// `seed` chooses the trial points.
JointPath shortened(const kinematics::Arm& arm, const CollisionChecker& checker, JointPath path, int trials,
                    std::uint64_t seed);

}  // namespace roci::arm
