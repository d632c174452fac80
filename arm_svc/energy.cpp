#include "arm_svc/energy.hpp"

#include <algorithm>
#include <cmath>

#include "arm_svc/inverse_dynamics.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

// Coulomb friction acts against motion only: a joint at rest holds for free what friction holds.
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

class Meter {
 public:
  Meter(const Arm& arm, const MotorModel& motor, double period_s)
      : arm_(arm), motor_(motor), period_s_(period_s) {}

  void add_phase(const TrajectorySegment& segment, double begin_s, double end_s) {
    if (end_s <= begin_s) return;
    const int steps = std::max(1, static_cast<int>(std::ceil((end_s - begin_s) / period_s_)));
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
    const double end = segment.duration_s();
    meter.add_phase(segment, 0.0, segment.ramp_s);
    meter.add_phase(segment, segment.ramp_s, end - segment.ramp_s);
    meter.add_phase(segment, end - segment.ramp_s, end);
  }
  return meter.use();
}

}  // namespace roci::arm
