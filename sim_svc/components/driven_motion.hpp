// An arm with motors, inertia and friction (type `dynamic_arm`) moves along a trajectory by a controller that believes
// in one load while the rigid body has another, so that durations and energies follow from the motion and not from the
// plan. The motion is integrated whole, in steps of its own, so that nothing depends on how time is sliced.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/kinematics/arm.hpp"
#include "sim_svc/components/arm_dynamics.hpp"
#include "sim_svc/components/arm_motion.hpp"
#include "sim_svc/components/joint_course.hpp"

namespace roci::sim::components {

/// Holds what the true arm is, how it is controlled, and what that takes. Its energy law and its constants are the
/// simulator's own; arm_svc has others (arm_svc/energy.hpp).
struct DrivenArmParameters {
  std::shared_ptr<const kinematics::Arm> arm;            ///< with its friction and limits; never null
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();     ///< m/s² in the base's frame
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitX();  ///< along it the tool holds a load
  double bandwidth = 4;                                  ///< of the controller, rad/s
  double motor_strength = 1;                             ///< share of the effort limits that the motors have
  double rotor_share = 0.1;      ///< of a joint's effort at its acceleration limit that its own rotor takes
  double continuous_load = 0.6;  ///< share of its effort above which a motor is driven slower
  double follow_rad = 0.03;      ///< rad or m behind the course at which the controller waits
  double settled_rad = 0.005;    ///< rad or m from the target within which the arm has arrived,
  double settled_rad_s = 0.005;  ///< and rad/s or m/s below which it is at rest,
  double settle_s = 0.5;         ///< once both have held for so long
  double stall_s = 20;           ///< a motion that has not got on for so long has failed
  double friction_noise = 0.1;   ///< standard deviation of a motion's friction, as a share of it
  double electronics_w = 15;
  double gear_efficiency = 0.75;
  double copper_loss_w = 40;  ///< of a motor at its effort limit
};

/// Says how heavily each joint has come to move, in N·m or N beside its friction.
struct JointsWear {
  kinematics::JointVector friction;
  kinematics::JointVector growth;  ///< of the friction for each rad or m of travel
};

/// Holds the state of a motion at one time.
struct DrivenMoment {
  kinematics::JointVector position;
  kinematics::JointVector rate;
  kinematics::JointVector held;     ///< effort of the controller's integral part
  kinematics::JointVector pressed;  ///< friction of the last step, N·m·s or N·s
  kinematics::JointVector load;     ///< of each motor over about a second, share of its effort limit
  JointsWear wear;
  double course_s = 0;  ///< how far along the course the controller is
  double pace = 1;      ///< of the course per s
  double energy_j = 0;
};

/// Describes a whole motion as it happens if nobody interrupts it; moment i holds at i * kArmStep after its
/// start.
///
/// The controller follows the course by PID with a feed-forward from the inverse dynamics of the believed arm (computed
/// torque in its per-joint form; Siciliano et al., Robotics, 2009, section 8.5), all with saturating motors; it waits
/// on the course where a joint falls behind or a motor is overloaded (online trajectory time scaling; Dahl and Nielsen,
/// "Torque-limited path following by online trajectory time scaling", 1990). The true arm is integrated by the
/// semi-implicit Euler method with Coulomb friction as a bounded impulse (Stewart and Trinkle, 1996).
class DrivenMotion {
 public:
  /// `from` and the targets have a value for each joint. `friction` is a factor on the joints' own friction.
  DrivenMotion(const DrivenArmParameters&, const std::vector<double>& from, JointsWear wear,
               const std::vector<world::JointTarget>&, const kinematics::MassProperties& believed_load,
               const kinematics::MassProperties& true_load, double friction);

  /// Works the motion out anew from the moment on, with this wear.
  void go_on_from(std::size_t moment, JointsWear wear);
  /// Returns the wear at the moment, or at the last one.
  const JointsWear& wear_at(std::size_t moment) const;
  ArmTrace trace(temporal::Time start) const;

 private:
  struct Control;
  void run();
  void plan(const DrivenMoment&, Control&) const;
  void step(DrivenMoment&, const Control&, double& peak_power_w) const;
  std::string short_of_target(const DrivenMoment&) const;

  DrivenArmParameters parameters_;
  JointCourse course_;
  std::vector<double> rotors_;
  ArmDynamics believed_;
  ArmDynamics true_;
  double friction_;
  std::vector<DrivenMoment> moments_;
  double peak_power_w_ = 0;
  std::string stalled_;
};

}  // namespace roci::sim::components
