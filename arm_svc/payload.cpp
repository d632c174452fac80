#include "arm_svc/payload.hpp"

#include <cmath>
#include <limits>

#include "core/kinematics/mass.hpp"

namespace roci::arm {

using Eigen::Vector3d;

std::string fault_of(const Payload& payload) {
  if (!std::isfinite(payload.mass_kg) || payload.mass_kg < 0)
    return "the payload's mass must be a number of kg, 0 or more";
  const Vector3d& size = payload.size_m;
  if (!size.allFinite() || (size.array() < 0).any())
    return "the payload's size must be three numbers of m, 0 or more";
  if (!size.isZero(0.0) && !(size.array() > 0).all())
    return "the payload's size must be three numbers above 0, or none at all for a point";
  return {};
}

Vector3d held_centre(const Vector3d& size, const Vector3d& axis) {
  // The point where the axis, from the box's centre, leaves the box is half a box away.
  double half = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) > 1e-9) half = std::min(half, 0.5 * size[i] / std::abs(axis[i]));
  }
  return std::isfinite(half) ? Vector3d(half * axis) : Vector3d(Vector3d::Zero());
}

kinematics::Arm loaded(kinematics::Arm arm, const Payload& payload, const Vector3d& tool_axis) {
  if (payload.none()) return arm;
  const Vector3d& size = payload.size_m;
  kinematics::MassProperties mass;
  mass.mass = payload.mass_kg;
  mass.centre = held_centre(size, tool_axis);
  const Vector3d squares = size.cwiseProduct(size);
  mass.inertia.diagonal() =
      payload.mass_kg / 12.0 *
      Vector3d(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  Eigen::Isometry3d pose = arm.tool;
  pose.translation() = arm.tool * mass.centre;
  kinematics::Body& hand = arm.bodies.back();
  hand.mass = kinematics::joined(hand.mass, kinematics::moved(mass, arm.tool));
  if (!size.isZero(0.0)) hand.shapes.push_back({kLoad, pose, kinematics::Box{size}});
  return arm;
}

}  // namespace roci::arm
