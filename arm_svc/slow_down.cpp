#include "arm_svc/slow_down.hpp"

#include <algorithm>
#include <cmath>

namespace roci::arm {
namespace {

constexpr int kTrials = 60;
constexpr double kLeastStep = 1.1, kLargestStep = 2.0;

}  // namespace

std::optional<HoldingLoad> slow_down(const kinematics::Arm& arm, const MotorModel& motor,
                                     Trajectory& trajectory) {
  for (TrajectorySegment& segment : trajectory.segments) {
    const TrajectorySegment fastest = segment;
    double factor = 1.0;
    EnergyUse use = energy_of(arm, {{segment}}, motor);
    for (int trial = 0; use.peak_load > 1.0 && trial < kTrials; ++trial) {
      factor *= std::clamp(std::sqrt(use.peak_load), kLeastStep, kLargestStep);
      segment = slowed(fastest, factor);
      // A slow part is looked at in as many places as the fast one, not in every twentieth of a second.
      use = energy_of(arm, {{segment}}, motor, 0.05 * factor);
      if (factor > 1e4) break;
    }
    if (use.peak_load > 1.0) return HoldingLoad{use.peak_load, use.peak_joint};
  }
  return std::nullopt;
}

}  // namespace roci::arm
