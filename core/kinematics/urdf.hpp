// This file reads a serial arm from URDF text: the chain from the document's root link to a named tip.
//
// Fixed joints, also of side branches (a camera bracket, the chassis), fold into the bodies they hold; a
// movable joint off the chain is an error. `continuous` becomes revolute within ±2π. Beyond plain URDF,
// <limit> may carry `acceleration` and `jerk` (as in URDF 1.2). A box or sphere of collision geometry stays as it is; a
// cylinder longer than wide becomes the capsule around the same axis segment, a flatter one the box around
// it: both contain it. Meshes are refused.
#pragma once

#include <string>
#include <variant>

#include "core/kinematics/arm.hpp"

namespace roci::kinematics {

/// Says what the URDF itself leaves open.
struct UrdfOptions {
  std::string tip;  ///< link that is the tool frame
  /// Gives the time in which joints without an acceleration limit reach their speed limit.
  double time_to_speed_s = 0.5;
  /// Gives the time in which joints without a jerk limit reach their acceleration limit; 0: at once, without
  /// a jerk limit.
  double time_to_acceleration_s = 0;
};

/// Says why a document is no arm, and where.
struct UrdfError {
  std::string file;
  int line = 0;         ///< counts from 1; 0 stands for the document as a whole
  std::string element;  ///< e.g. "joint 'elbow'" or "robot"
  std::string message;  ///< what is wrong and how to mend it
};

/// Returns "file:line: element: message".
std::string to_string(const UrdfError& error);

/// Reads an arm, or says why there is none. `file` names the source in errors only.
std::variant<Arm, UrdfError> parse_urdf(const std::string& text, const std::string& file,
                                        const UrdfOptions& options);

}  // namespace roci::kinematics
