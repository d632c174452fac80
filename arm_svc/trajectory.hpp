// A trajectory puts time along a joint path: each straight part is run from rest to rest with a speed profile
// that all joints share, as fast as the speed, acceleration and jerk limits of the slowest joint allow. Without
// jerk limits the profile is a trapezoid (Siciliano et al., Robotics: Modelling, Planning and Control, 2009,
// section 4.2), with them a double S (Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and
// Robots, 2008, section 3.4).
#pragma once

#include <vector>

#include "arm_svc/path_search.hpp"
#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Describes one straight part; progress s runs from 0 to 1.
struct TrajectorySegment {
  kinematics::JointVector from;
  kinematics::JointVector to;
  double acceleration = 0;  ///< Is the largest of s, 1/s²; its negative at the end.
  double ramp_s = 0;        ///< Speed rises for so long, and falls for so long at the end.
  double cruise_s = 0;      ///< Speed is held for so long.
  double jerk_s = 0;        ///< Acceleration rises for so long at either end of a ramp; 0: at once.

  double duration_s() const { return 2.0 * ramp_s + cruise_s; }
};

/// Holds the state of all joints at one time.
struct JointState {
  kinematics::JointVector position;      ///< rad or m
  kinematics::JointVector velocity;      ///< per s
  kinematics::JointVector acceleration;  ///< per s²; at a change of phase that of the later phase
};

/// Holds a motion in time, from rest to rest in each segment.
struct Trajectory {
  std::vector<TrajectorySegment> segments;

  double duration_s() const;
  /// Returns the state at a time; times outside [0, duration] give the first or last state at rest. There
  /// must be at least one segment.
  JointState at(double time_s) const;
};

/// Returns the state at a time since the start of the segment, which is clamped to its duration.
JointState state_in(const TrajectorySegment& segment, double time_s);

/// Returns the same way in `factor` times the time.
TrajectorySegment slowed(const TrajectorySegment& segment, double factor);

/// Puts time along the path. Parts of no length are left out; a path that goes nowhere gives no segments.
Trajectory time_path(const kinematics::Arm& arm, const JointPath& path);

/// Returns the time in s that time_path() gives to the straight line between the two.
double line_duration_s(const kinematics::Arm& arm, const kinematics::JointVector& from,
                       const kinematics::JointVector& to);

/// Returns a time in s that no trajectory between the two can beat, whatever way it goes: that of the joint
/// which needs longest for its own part, alone and without stops. time_path() of any path with these ends takes
/// at least as long.
double duration_bound_s(const kinematics::Arm& arm, const kinematics::JointVector& from,
                        const kinematics::JointVector& to);

/// Holds where the joints stand at a time since the start.
struct TrajectorySample {
  double time_s = 0;
  kinematics::JointVector position;
  kinematics::JointVector velocity;
};

/// Returns samples `period_s` apart, and at every segment's start and end.
std::vector<TrajectorySample> sampled(const Trajectory& trajectory, double period_s);

}  // namespace roci::arm
