#pragma once
#include <vector>

#include "sim_svc/parameters.hpp"
#include "sim_svc/random_stream.hpp"
#include "sim_svc/values.hpp"

namespace roci::sim {

/// A commanded point of a joint-space trajectory: seconds since its start, rad (or m) per joint.
struct JointTarget {
  double time_s = 0;
  std::vector<double> joints;
};

struct ArmSample {
  std::vector<double> joints;
  double energy_j = 0;  ///< used since the start of the motion
};

/// A whole motion as it happens if nobody interrupts it; sample i holds at start + i * kArmStep.
struct ArmTrace {
  Time start{};
  std::vector<ArmSample> samples;
  double peak_power_w = 0;

  Time end() const;
  /// The last sample at or before the time.
  const ArmSample& at(Time) const;
};

inline constexpr Duration kArmStep{50000};

/// Each joint follows the trajectory as a first-order lag; the speed of the whole motion is off by a factor
/// drawn from the noise. Ends when the trajectory has ended and every joint has settled. `targets` has
/// ascending times and as many joints per point as `from`; see motion_fault().
ArmTrace simulate_arm(const ArmParameters&, Time start, const std::vector<double>& from,
                      const std::vector<JointTarget>& targets, RandomStream& noise);

/// Empty, or why an arm that stands at `from` cannot follow the trajectory.
std::string motion_fault(const std::vector<double>& from, const std::vector<JointTarget>& targets);

}  // namespace roci::sim
