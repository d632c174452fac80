// This file reads an ArmSetup from mission data: a URDF and a file of poses.
//
// The file of poses goes in m, rad, W and m/s²; its base frame is the URDF's root link:
//   tip: scoop_tip                    link that is the tool frame
//   tool_axis: [1, 0, 0]              axis of the tool frame that `approach` turns and loads lie along; default x
//   time_to_speed: 0.5                s, for joints without an acceleration limit
//   time_to_acceleration: 0.2         s, for joints without a jerk limit; left out: those have none
//   ground: -0.6                      height of level ground; left out in free space
//   margin: 0.01                      clearance, 0.001 to 0.1
//   may_touch: [[a, b]]               links (or a link and ground) whose contact is harmless
//   motor: {gravity: [0, 0, -3.71], idle: 6, efficiency: 0.7, full_effort_loss: 60}      see energy.hpp
//   search: {iterations: 2000, shortcuts: 60}
//   poses:
//     stow: {joints: [0, -2, 2, 0, 0]}
//     pick: {position: [0.9, 0, -0.5], approach: [0, 0, -1]}     or rpy: [r, p, y], or position alone
//     s0: {position: [2, 0, 0.4], approach: [0, 0, -1], module: [0.4, 0.4, 0.4]}
// `module` is the box (edges along the base axes) that the tool grasps there, in the middle of the face that it
// comes to: an obstacle for all motions that neither start nor end at s0. With an approach along a base axis the
// tool stands square to it. What the tool carries is called `load` in may_touch, the box `module at s0`.
#pragma once

#include <filesystem>

#include "arm_svc/setup.hpp"

namespace roci::arm {

/// Reads the setup. Throws mission::FileError with file, line (and column in YAML), what is wrong and the
/// remedy.
ArmSetup load_setup(const std::filesystem::path& urdf, const std::filesystem::path& poses);

}  // namespace roci::arm
