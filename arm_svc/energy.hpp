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

/// Holds the joint that is nearest to its effort limit, and its share of it.
struct HoldingLoad {
  double load = 0;  ///< |τ| / effort limit
  std::size_t joint = 0;
};

/// Returns the least load that keeps the arm still at `q`: Coulomb friction holds as much as it can, and the motors the
/// rest.
HoldingLoad holding_load(const kinematics::Arm& arm, const kinematics::JointVector& q,
                         const MotorModel& motor);

/// Returns an energy in J that no motion between the two stays below, whatever way it goes: idle power over
/// duration_bound_s(), and through the gears at least the gain of potential energy and what Coulomb friction
/// takes on the shortest way of each joint (from rest to rest, kinetic energy is given back at best).
double energy_bound_j(const kinematics::Arm& arm, const kinematics::JointVector& from,
                      const kinematics::JointVector& to, const MotorModel& motor);

}  // namespace roci::arm
