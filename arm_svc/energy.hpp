// The electrical energy of a motion is computed by a geared DC motor at each joint (after Verstraten et al.,
// "Modeling and design of geared DC motors for energy efficiency", Mechatronics 30, 2015, with the motor's
// own inertia left out):
//
//   P = idle + Σ_j [ max(0, τ_j · v_j) / efficiency + full_effort_loss · (τ_j / effort limit_j)² ]
//   τ_j = inverse dynamics (gravity = holding, inertia = kinetic) + friction · sign(v_j) + damping · v_j
//
// Braking power is not recovered; the squared term is the copper loss of the holding current.
#pragma once

#include "arm_svc/trajectory.hpp"

namespace roci::arm {

/// Holds the parameters of the model above, in SI units.
struct MotorModel {
  Eigen::Vector3d gravity{0, 0, -3.71};  ///< m/s² in the base frame
  double idle_w = 0;                     ///< The electronics draw it all the time.
  double efficiency = 0.7;               ///< Gear and motor have it, 0 < efficiency <= 1.
  double full_effort_loss_w = 0;         ///< Is the copper loss of a joint that exerts its effort limit.
};

/// Holds what a motion uses, and how near its motors come to their limits.
struct EnergyUse {
  double energy_j = 0;
  double peak_load = 0;  ///< Is the largest |τ_j| / effort limit on the way; above 1 the motors fail.
  std::size_t peak_joint = 0;
};

/// Integrates by the midpoint rule, with steps of at most `period_s`, phase by phase.
EnergyUse energy_of(const kinematics::Arm& arm, const Trajectory& trajectory, const MotorModel& motor,
                    double period_s = 0.05);

}  // namespace roci::arm
