// These checks give URDF errors a line: urdfdom keeps no positions, so the document is read with tinyxml2
// first.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

#include "core/kinematics/urdf.hpp"

namespace roci::kinematics {

/// Holds what later stages need from the document and urdfdom does not keep.
struct UrdfNotes {
  std::map<std::string, int> link_line;
  std::map<std::string, int> joint_line;
  std::map<std::string, double> acceleration;  ///< joints whose <limit> gives one
  std::map<std::string, double> jerk;          ///< joints whose <limit> gives one
};

/// Checks a document. One that passes has unique names, known joint types, finite numbers, limits with lower < upper
/// within ±1000 rad or m, speed, acceleration and jerk from 1e-4 to 1e4 and efforts from 1e-3 to 1e7 (SI) on every
/// movable joint, no zero axis, no mesh in <collision>, positive sizes, no negative mass or moment of inertia, and
/// links that form one tree. Returns the first error otherwise, under the name `file`.
std::variant<UrdfNotes, UrdfError> check_urdf(const std::string& text, const std::string& file);

}  // namespace roci::kinematics
