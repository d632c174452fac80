#include "arm_svc/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

bool goes_nowhere(const JointVector& from, const JointVector& to) {
  return (to - from).cwiseAbs().maxCoeff() <= 0.0;
}

TrajectorySegment time_line(const Arm& arm, const JointVector& from, const JointVector& to) {
  double speed = std::numeric_limits<double>::infinity(), acceleration = speed;  // of s
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    const double length = std::abs(to[i] - from[i]);
    if (length <= 0.0) continue;
    const auto& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    speed = std::min(speed, limits.velocity / length);
    acceleration = std::min(acceleration, limits.acceleration / length);
  }
  const double ramp = std::min(speed / acceleration, std::sqrt(1.0 / acceleration));
  const double cruise = std::max(0.0, 1.0 / (acceleration * ramp) - ramp);
  return {from, to, acceleration, ramp, cruise};
}

}  // namespace

double Trajectory::duration_s() const {
  double sum = 0;
  for (const TrajectorySegment& segment : segments) sum += segment.duration_s();
  return sum;
}

JointState state_in(const TrajectorySegment& segment, double time_s) {
  const double a = segment.acceleration, ramp = segment.ramp_s, end = segment.duration_s();
  const double t = std::clamp(time_s, 0.0, end);
  double s, rate, change;
  if (t < ramp) {
    s = 0.5 * a * t * t, rate = a * t, change = a;
  } else if (t < end - ramp) {
    s = a * ramp * (t - 0.5 * ramp), rate = a * ramp, change = 0.0;
  } else {
    s = 1.0 - 0.5 * a * (end - t) * (end - t), rate = a * (end - t), change = -a;
  }
  if (time_s < 0.0 || time_s >= end) change = 0.0;
  const JointVector way = segment.to - segment.from;
  return {segment.from + s * way, rate * way, change * way};
}

JointState Trajectory::at(double time_s) const {
  double begin = 0;
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const double end = begin + segments[i].duration_s();
    if (time_s < end) return state_in(segments[i], time_s - begin);
    begin = end;
  }
  return state_in(segments.back(), time_s - begin);
}

Trajectory time_path(const Arm& arm, const JointPath& path) {
  Trajectory trajectory;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!goes_nowhere(path[i - 1], path[i]))
      trajectory.segments.push_back(time_line(arm, path[i - 1], path[i]));
  }
  return trajectory;
}

double line_duration_s(const Arm& arm, const JointVector& from, const JointVector& to) {
  return goes_nowhere(from, to) ? 0.0 : time_line(arm, from, to).duration_s();
}

std::vector<TrajectorySample> sampled(const Trajectory& trajectory, double period_s) {
  std::vector<TrajectorySample> samples;
  double begin = 0;
  for (const TrajectorySegment& segment : trajectory.segments) {
    if (samples.empty()) samples.push_back({0.0, segment.from, JointVector::Zero(segment.from.size())});
    const int steps = std::max(1, static_cast<int>(std::ceil(segment.duration_s() / period_s)));
    for (int i = 1; i <= steps; ++i) {
      const double t = segment.duration_s() * i / steps;
      const JointState state = state_in(segment, t);
      samples.push_back({begin + t, state.position, state.velocity});
    }
    begin += segment.duration_s();
  }
  return samples;
}

}  // namespace roci::arm
