// A payload is what the tool carries: a box of even density, or a point.
#pragma once

#include <string>

#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Names the load in contacts and in `may_touch`.
inline constexpr const char* kLoad = "load";

/// Holds mass and size of what the tool carries. The tool holds the middle of the face that its axis points
/// into: the box lies beyond the tool's origin along that axis.
struct Payload {
  double mass_kg = 0;                                ///< 0: nothing is carried, if the size is 0 as well
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Edges along x, y and z of the tool; zeros: a point.

  bool none() const { return mass_kg <= 0 && size_m.isZero(0.0); }
};

/// Returns the text that says what is wrong with it, and how to mend it; empty if nothing is.
std::string fault_of(const Payload& payload);

/// Returns the centre of a box of this size that is held in the middle of the face which `axis` points into,
/// seen from the point that holds it; axes of box and vector are the same.
Eigen::Vector3d held_centre(const Eigen::Vector3d& size, const Eigen::Vector3d& axis);

/// Returns the arm with the payload fixed to its last body, as mass and as a shape of the link "load". `tool_axis`
/// is a unit vector in the tool frame.
kinematics::Arm loaded(kinematics::Arm arm, const Payload& payload, const Eigen::Vector3d& tool_axis);

}  // namespace roci::arm
