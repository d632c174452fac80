// This file reads an arm's settings from the files of a mission.
#pragma once

#include "sim_svc/components/arm.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `arm` (README.md). Throws mission::FileError.
ArmSettings read_arm_settings(setup::Settings&);

/// Reads those that every arm has: who plans, the names of its poses, where it starts. Throws mission::FileError.
ArmSettings read_common_arm_settings(setup::Settings&);

/// Returns the entry that names the file of the arm's poses: the component's own, else the mission's `arm: {poses: …}`.
mission::Entry poses_file_of(setup::Settings&);

}  // namespace roci::sim::components
