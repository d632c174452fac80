#include "core/kinematics/mass.hpp"

namespace roci::kinematics {
namespace {

// Returns the inertia of a point mass at `arm` about the origin.
Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

}  // namespace

MassProperties moved(const MassProperties& part, const Eigen::Isometry3d& pose) {
  return {part.mass, pose * part.centre, pose.linear() * part.inertia * pose.linear().transpose()};
}

MassProperties joined(const MassProperties& a, const MassProperties& b) {
  const double mass = a.mass + b.mass;
  if (mass <= 0) return {};
  const Eigen::Vector3d centre = (a.mass * a.centre + b.mass * b.centre) / mass;
  const Eigen::Matrix3d inertia = a.inertia + point_inertia(a.mass, a.centre - centre) + b.inertia +
                                  point_inertia(b.mass, b.centre - centre);
  return {mass, centre, inertia};
}

}  // namespace roci::kinematics
