// This file reads the settings of a sampling arm in mission and scenario files.
#pragma once
#include "sim_svc/components/sampling_arm.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `sampling_arm` (README.md). Throws mission::FileError.
SamplingArmSettings read_sampling_arm_settings(setup::Settings&);

}  // namespace roci::sim::components
