#include "sim_svc/components/arm_motion.hpp"

#include <algorithm>
#include <cmath>

namespace roci::sim::components {

using temporal::Time;
using world::JointTarget;
using world::RandomStream;

namespace {

constexpr double kArmStepSeconds = 0.05;
constexpr double kLargestJump = 0.1;  // rad between where the arm stands and where a trajectory starts

std::vector<double> commanded(const std::vector<JointTarget>& targets, double time_s) {
  const auto after = std::find_if(targets.begin(), targets.end(),
                                  [&](const JointTarget& target) { return target.time_s > time_s; });
  if (after == targets.end()) return targets.back().joints;
  if (after == targets.begin()) return targets.front().joints;
  const JointTarget& a = *(after - 1);
  const double share = (time_s - a.time_s) / (after->time_s - a.time_s);
  std::vector<double> out = a.joints;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * (after->joints[i] - a.joints[i]);
  return out;
}

}  // namespace

Time ArmTrace::end() const { return start + static_cast<std::int64_t>(samples.size() - 1) * kArmStep; }

const ArmSample& ArmTrace::at(Time t) const {
  if (t <= start) return samples.front();
  return samples[std::min(samples.size() - 1, static_cast<std::size_t>((t - start) / kArmStep))];
}

ArmTrace simulate_arm(const ArmParameters& parameters, Time start, const std::vector<double>& from,
                      const std::vector<JointTarget>& targets, RandomStream& noise) {
  ArmTrace trace{start, {{from, 0}}, parameters.base_power_w, {}};
  const double pace = std::clamp(1 + parameters.speed_noise * noise.normal(), 0.5, 1.5);
  const double approach = 1 - std::exp(-kArmStepSeconds / parameters.joint_lag_s);
  for (double time_s = kArmStepSeconds;; time_s += kArmStepSeconds) {
    ArmSample next = trace.samples.back();
    const std::vector<double> reference = commanded(targets, time_s * pace);
    double moved = 0;
    double error = 0;
    for (std::size_t i = 0; i < next.joints.size(); ++i) {
      const double step = approach * (reference[i] - next.joints[i]);
      next.joints[i] += step;
      moved += std::abs(step);
      error = std::max(error, std::abs(targets.back().joints[i] - next.joints[i]));
    }
    const double power = parameters.base_power_w + parameters.power_per_speed_w * moved / kArmStepSeconds;
    next.energy_j += power * kArmStepSeconds;
    trace.peak_power_w = std::max(trace.peak_power_w, power);
    trace.samples.push_back(std::move(next));
    if (time_s * pace >= targets.back().time_s && error < parameters.settled_rad) return trace;
  }
}

std::string motion_fault(const std::vector<double>& from, const std::vector<JointTarget>& targets) {
  if (targets.empty()) return "the trajectory has no points";
  double time_s = 0;
  for (const JointTarget& target : targets) {
    if (target.joints.size() != from.size()) {
      return "the trajectory has " + std::to_string(target.joints.size()) + " joints, the arm has " +
             std::to_string(from.size());
    }
    if (!std::isfinite(target.time_s) || target.time_s < time_s)
      return "the trajectory's times do not ascend";
    time_s = target.time_s;
    for (const double joint : target.joints) {
      if (!std::isfinite(joint)) return "the trajectory holds a value that is not finite";
    }
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (std::abs(targets.front().joints[i] - from[i]) > kLargestJump) {
      return "the trajectory starts elsewhere than the arm stands (joint " + std::to_string(i) + ")";
    }
  }
  return {};
}

}  // namespace roci::sim::components
