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

// Bounds the progress s of a straight part, per s, s² and s³; a jerk of 0 stands for none.
struct ProgressLimits {
  double speed = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();
  double jerk = 0;

  // Takes the limits of a joint that goes `length` while s goes from 0 to 1.
  void add(const kinematics::JointLimits& limits, double length) {
    speed = std::min(speed, limits.velocity / length);
    acceleration = std::min(acceleration, limits.acceleration / length);
    if (limits.jerk <= 0) return;
    jerk = jerk > 0 ? std::min(jerk, limits.jerk / length) : limits.jerk / length;
  }
};

void set_trapezoid(TrajectorySegment& segment, const ProgressLimits& limits) {
  const double speed = limits.speed, acceleration = limits.acceleration;
  segment.acceleration = acceleration;
  segment.ramp_s = std::min(speed / acceleration, std::sqrt(1.0 / acceleration));
  segment.cruise_s = std::max(0.0, 1.0 / (acceleration * segment.ramp_s) - segment.ramp_s);
}

// Is the symmetric case of section 3.4: rest to rest, a way of 1, equal limits for both ramps.
void set_double_s(TrajectorySegment& segment, const ProgressLimits& limits) {
  const double v = limits.speed, a = limits.acceleration, j = limits.jerk;
  const bool held = v * j > a * a;  // the acceleration limit is reached
  segment.jerk_s = held ? a / j : std::sqrt(v / j);
  segment.ramp_s = segment.jerk_s + (held ? v / a : segment.jerk_s);
  segment.cruise_s = 1.0 / v - segment.ramp_s;
  if (segment.cruise_s < 0) {  // too short a way for the speed limit
    segment.cruise_s = 0;
    const double rise = a / j;
    if (a * rise * rise * 2.0 <= 1.0) {
      segment.jerk_s = rise;
      segment.ramp_s = 0.5 * rise + std::sqrt(0.25 * rise * rise + 1.0 / a);
    } else {
      segment.jerk_s = std::cbrt(0.5 / j);
      segment.ramp_s = 2.0 * segment.jerk_s;
    }
  }
  // The way is exactly 1 with this acceleration, however the times were rounded.
  segment.acceleration = 1.0 / ((segment.ramp_s - segment.jerk_s) * (segment.ramp_s + segment.cruise_s));
}

void set_profile(TrajectorySegment& segment, const ProgressLimits& limits) {
  if (limits.jerk > 0) {
    set_double_s(segment, limits);
  } else {
    set_trapezoid(segment, limits);
  }
}

TrajectorySegment time_line(const Arm& arm, const JointVector& from, const JointVector& to) {
  ProgressLimits limits;
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    const double length = std::abs(to[i] - from[i]);
    if (length > 0.0) limits.add(arm.joints[static_cast<std::size_t>(i)].limits, length);
  }
  TrajectorySegment segment{from, to};
  set_profile(segment, limits);
  return segment;
}

// Holds s and its first two derivatives.
struct Progress {
  double s, rate, change;
};

// Returns the progress of a double S, `t` after its start and not after the middle of the way.
Progress rising(const TrajectorySegment& segment, double t) {
  const double a = segment.acceleration, ramp = segment.ramp_s, rise = segment.jerk_s, j = a / rise;
  const double v = a * (ramp - rise);
  if (t < rise) return {j * t * t * t / 6.0, 0.5 * j * t * t, j * t};
  if (t < ramp - rise)
    return {a / 6.0 * (3.0 * t * t - 3.0 * rise * t + rise * rise), a * (t - 0.5 * rise), a};
  if (t >= ramp) return {v * (t - 0.5 * ramp), v, 0.0};
  const double left = ramp - t;
  return {v * (0.5 * ramp - left) + j * left * left * left / 6.0, v - 0.5 * j * left * left, j * left};
}

Progress double_s(const TrajectorySegment& segment, double t) {
  const double end = segment.duration_s();
  if (t <= 0.5 * end) return rising(segment, t);
  const Progress mirrored = rising(segment, end - t);
  return {1.0 - mirrored.s, mirrored.rate, -mirrored.change};
}

Progress trapezoid(const TrajectorySegment& segment, double t) {
  const double a = segment.acceleration, ramp = segment.ramp_s, end = segment.duration_s();
  if (t < ramp) return {0.5 * a * t * t, a * t, a};
  if (t < end - ramp) return {a * ramp * (t - 0.5 * ramp), a * ramp, 0.0};
  return {1.0 - 0.5 * a * (end - t) * (end - t), a * (end - t), -a};
}

}  // namespace

double Trajectory::duration_s() const {
  double sum = 0;
  for (const TrajectorySegment& segment : segments) sum += segment.duration_s();
  return sum;
}

JointState state_in(const TrajectorySegment& segment, double time_s) {
  const double end = segment.duration_s();
  const double t = std::clamp(time_s, 0.0, end);
  Progress progress = segment.jerk_s > 0 ? double_s(segment, t) : trapezoid(segment, t);
  if (time_s < 0.0 || time_s >= end) progress.change = 0.0;
  const JointVector way = segment.to - segment.from;
  return {segment.from + progress.s * way, progress.rate * way, progress.change * way};
}

TrajectorySegment slowed(const TrajectorySegment& segment, double factor) {
  TrajectorySegment slow = segment;
  slow.acceleration /= factor * factor;
  slow.ramp_s *= factor;
  slow.cruise_s *= factor;
  slow.jerk_s *= factor;
  return slow;
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

double duration_bound_s(const Arm& arm, const JointVector& from, const JointVector& to) {
  constexpr double kRounding = 1e-9;
  double longest = 0;
  for (Eigen::Index i = 0; i < from.size(); ++i) {
    const double length = std::abs(to[i] - from[i]);
    if (length <= 0.0) continue;
    ProgressLimits limits;
    limits.add(arm.joints[static_cast<std::size_t>(i)].limits, length);
    TrajectorySegment alone;
    set_profile(alone, limits);
    longest = std::max(longest, alone.duration_s());
  }
  return longest * (1.0 - kRounding);
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
