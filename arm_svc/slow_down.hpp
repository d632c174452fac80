// What the motors cannot do at full speed they may do more slowly: forces of inertia fall with the square of the
// time that a part of the way takes (Hollerbach, "Dynamic scaling of manipulator trajectories", ASME Journal of
// Dynamic Systems, Measurement, and Control 106(1), 1984).
#pragma once

#include <optional>

#include "arm_svc/energy.hpp"

namespace roci::arm {

/// Gives every part of the trajectory in which a motor would exceed its effort limit the time that keeps all of
/// them inside. Returns the joint that cannot be kept inside, where there is one: its motor would have to exert
/// more however slowly it moves; the trajectory is then of no use.
std::optional<HoldingLoad> slow_down(const kinematics::Arm& arm, const MotorModel& motor,
                                     Trajectory& trajectory);

}  // namespace roci::arm
