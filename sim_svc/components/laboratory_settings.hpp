// This file reads the settings of a laboratory in mission and scenario files.
#pragma once
#include "sim_svc/components/laboratory.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `laboratory` (README.md). Throws mission::FileError.
LaboratorySettings read_laboratory_settings(setup::Settings&);

}  // namespace roci::sim::components
