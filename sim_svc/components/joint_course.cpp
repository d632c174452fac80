#include "sim_svc/components/joint_course.hpp"

#include <algorithm>

namespace roci::sim::components {

using kinematics::JointVector;

namespace {

constexpr double kSameTime = 1e-6;  // s

}  // namespace

JointCourse::JointCourse(const std::vector<world::JointTarget>& targets) {
  for (const world::JointTarget& target : targets) {
    const auto count = static_cast<Eigen::Index>(target.joints.size());
    const JointVector position = Eigen::Map<const Eigen::VectorXd>(target.joints.data(), count);
    if (!knots_.empty() && target.time_s - knots_.back().time_s < kSameTime) {
      knots_.back().position = position;
    } else {
      knots_.push_back({target.time_s, position, JointVector::Zero(count)});
    }
  }
  for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
    const Knot &before = knots_[i - 1], &after = knots_[i + 1];
    Knot& here = knots_[i];
    const double back = here.time_s - before.time_s, ahead = after.time_s - here.time_s;
    here.slope = ((here.position - before.position) * (ahead / back) +
                  (after.position - here.position) * (back / ahead)) /
                 (back + ahead);
  }
}

CoursePoint JointCourse::at(double time_s) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time_s,
                                      [](double time, const Knot& knot) { return time < knot.time_s; });
  if (after == knots_.begin() || after == knots_.end()) {
    const Knot& rest = after == knots_.begin() ? knots_.front() : knots_.back();
    const JointVector zero = JointVector::Zero(rest.position.size());
    return {rest.position, zero, zero};
  }
  const Knot &a = *(after - 1), &b = *after;
  const double length = b.time_s - a.time_s, u = (time_s - a.time_s) / length;
  const JointVector step = b.position - a.position;
  const JointVector square = 3 * step - length * (2 * a.slope + b.slope);
  const JointVector cube = length * (a.slope + b.slope) - 2 * step;
  return {a.position + u * (length * a.slope + u * (square + u * cube)),
          a.slope + u * (2 * square + 3 * u * cube) / length,
          (2 * square + 6 * u * cube) / (length * length)};
}

}  // namespace roci::sim::components
