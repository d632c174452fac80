// A joint course is what an arm's controller follows: a smooth curve through the points of a trajectory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/kinematics/arm.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

/// Holds where the joints should be at one time of the course: rad or m, per s and per s².
struct CoursePoint {
  kinematics::JointVector position;
  kinematics::JointVector rate;
  kinematics::JointVector change;
};

/// Holds a cubic Hermite curve whose slopes are those of the parabolas through three neighbouring points (de Boor, A
/// Practical Guide to Splines, 1978, chapter IV, "cubic Bessel interpolation"); it rests before its first and behind
/// its last point.
class JointCourse {
 public:
  /// There must be at least one target, and their times must ascend; of points at the same time the last counts.
  explicit JointCourse(const std::vector<world::JointTarget>&);

  CoursePoint at(double time_s) const;
  double duration_s() const { return knots_.back().time_s; }
  const kinematics::JointVector& end() const { return knots_.back().position; }

 private:
  struct Knot {
    double time_s = 0;
    kinematics::JointVector position;
    kinematics::JointVector slope;
  };
  std::vector<Knot> knots_;
};

}  // namespace roci::sim::components
