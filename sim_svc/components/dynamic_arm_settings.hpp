// This file reads a dynamic arm's settings from the files of a mission.
#pragma once

#include "sim_svc/components/dynamic_arm.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `dynamic_arm` (README.md), and the arm that they name. Throws
/// mission::FileError.
DynamicArmSettings read_dynamic_arm_settings(setup::Settings&);

}  // namespace roci::sim::components
