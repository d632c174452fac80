#include "arm_svc/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "arm_svc/inverse_dynamics.hpp"
#include "core/kinematics/forward.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

// Coulomb friction acts against motion. What it would hold of a joint at rest is left out: the motor counts as holding
// all of it.
JointVector motor_efforts(const Arm& arm, const JointState& state, const Eigen::Vector3d& gravity) {
  JointVector efforts = joint_efforts(arm, state, gravity);
  for (Eigen::Index i = 0; i < efforts.size(); ++i) {
    const auto& joint = arm.joints[static_cast<std::size_t>(i)];
    const double rate = state.velocity[i];
    const double sign = rate > 0 ? 1.0 : rate < 0 ? -1.0 : 0.0;
    efforts[i] += joint.friction * sign + joint.damping * rate;
  }
  return efforts;
}

double potential_energy(const Arm& arm, const JointVector& q, const Eigen::Vector3d& gravity) {
  const auto poses = kinematics::body_poses(arm, q);
  double energy = 0;
  for (std::size_t body = 1; body < poses.size(); ++body) {
    const kinematics::MassProperties& mass = arm.bodies[body].mass;
    energy -= mass.mass * gravity.dot(poses[body] * mass.centre);
  }
  return energy;
}

class Meter {
 public:
  Meter(const Arm& arm, const MotorModel& motor, double period_s)
      : arm_(arm), motor_(motor), period_s_(period_s) {}

  void add_phase(const TrajectorySegment& segment, double begin_s, double end_s) {
    if (end_s <= begin_s) return;
    // Speed is a parabola while acceleration changes: the midpoints of a few steps see it well enough.
    const int fewest = segment.jerk_s > 0 ? 4 : 1;
    const int steps = std::max(fewest, static_cast<int>(std::ceil((end_s - begin_s) / period_s_)));
    const double step = (end_s - begin_s) / steps;
    for (int i = 0; i < steps; ++i) add(state_in(segment, begin_s + (i + 0.5) * step), step);
  }

  EnergyUse use() const { return use_; }

 private:
  void add(const JointState& state, double step_s) {
    const JointVector efforts = motor_efforts(arm_, state, motor_.gravity);
    double power = motor_.idle_w;
    for (Eigen::Index i = 0; i < efforts.size(); ++i) {
      const double load = std::abs(efforts[i]) / arm_.joints[static_cast<std::size_t>(i)].limits.effort;
      power += std::max(0.0, efforts[i] * state.velocity[i]) / motor_.efficiency;
      power += motor_.full_effort_loss_w * load * load;
      if (load > use_.peak_load) {
        use_.peak_load = load;
        use_.peak_joint = static_cast<std::size_t>(i);
      }
    }
    use_.energy_j += power * step_s;
  }

  const Arm& arm_;
  const MotorModel& motor_;
  double period_s_;
  EnergyUse use_;
};

}  // namespace

EnergyUse energy_of(const Arm& arm, const Trajectory& trajectory, const MotorModel& motor, double period_s) {
  Meter meter(arm, motor, period_s);
  for (const TrajectorySegment& segment : trajectory.segments) {
    const double end = segment.duration_s(), ramp = segment.ramp_s, rise = segment.jerk_s;
    if (rise > 0) {
      const std::array<double, 8> phases{0,          rise, ramp - rise, ramp, end - ramp, end - ramp + rise,
                                         end - rise, end};
      for (std::size_t i = 1; i < phases.size(); ++i) meter.add_phase(segment, phases[i - 1], phases[i]);
      continue;
    }
    meter.add_phase(segment, 0.0, ramp);
    meter.add_phase(segment, ramp, end - ramp);
    meter.add_phase(segment, end - ramp, end);
  }
  return meter.use();
}

HoldingLoad holding_load(const Arm& arm, const JointVector& q, const MotorModel& motor) {
  const JointVector rest = JointVector::Zero(q.size());
  const JointVector efforts = joint_efforts(arm, {q, rest, rest}, motor.gravity);
  HoldingLoad most;
  for (Eigen::Index i = 0; i < efforts.size(); ++i) {
    const auto& joint = arm.joints[static_cast<std::size_t>(i)];
    const double load = std::max(0.0, std::abs(efforts[i]) - joint.friction) / joint.limits.effort;
    if (load > most.load) most = {load, static_cast<std::size_t>(i)};
  }
  return most;
}

double energy_bound_j(const Arm& arm, const JointVector& from, const JointVector& to,
                      const MotorModel& motor) {
  constexpr double kQuadrature = 0.02;  // energy_of() is nearer than this to the integral
  const double idle = motor.idle_w * duration_bound_s(arm, from, to);
  double work = potential_energy(arm, to, motor.gravity) - potential_energy(arm, from, motor.gravity);
  for (Eigen::Index i = 0; i < from.size(); ++i)
    work += arm.joints[static_cast<std::size_t>(i)].friction * std::abs(to[i] - from[i]);
  return idle + std::max(0.0, work) / motor.efficiency / (1.0 + kQuadrature);
}

}  // namespace roci::arm
