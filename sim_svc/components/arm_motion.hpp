// This is the motion of the simple arm (type `arm`), whose joints lag behind the trajectory, and what the simulator
// keeps of every arm's motion, a trace.
#pragma once

#include <string>
#include <vector>

#include "sim_svc/world/random_stream.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

/// Holds how the true arm moves and what that takes.
struct ArmParameters {
  double joint_lag_s = 0.25;
  double speed_noise = 0.03;  ///< standard deviation of the speed of a whole motion, as a share of it
  double settled_rad = 0.005;
  double base_power_w = 12;
  double power_per_speed_w = 25;  ///< per rad/s, summed over the joints
};

/// Holds where the arm stands at one time of a motion.
struct ArmSample {
  std::vector<double> joints;
  double energy_j = 0;  ///< used since the start of the motion
};

/// Describes a whole motion as it happens if nobody interrupts it; sample i holds at start + i * kArmStep.
struct ArmTrace {
  temporal::Time start{};
  std::vector<ArmSample> samples;
  double peak_power_w = 0;
  std::string stalled{};  ///< why it ended short of its target, in plain words; empty: it arrived

  temporal::Time end() const;
  /// Returns the last sample at or before the time.
  const ArmSample& at(temporal::Time) const;
};

inline constexpr temporal::Duration kArmStep{50000};

/// Works out a motion: each joint follows the trajectory as a first-order lag, and the speed of the whole
/// motion is off by a factor drawn from the noise. It ends when the trajectory has ended and every joint has
/// settled. `targets` has ascending times and as many joints per point as `from`; see motion_fault().
ArmTrace simulate_arm(const ArmParameters&, temporal::Time start, const std::vector<double>& from,
                      const std::vector<world::JointTarget>& targets, world::RandomStream& noise);

/// Says why an arm that stands at `from` cannot follow the trajectory; the text is empty if it can.
std::string motion_fault(const std::vector<double>& from, const std::vector<world::JointTarget>& targets);

}  // namespace roci::sim::components
