// This file reads the settings of a drive in mission and scenario files.
#pragma once
#include "sim_svc/components/drive.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a drive (README.md). Throws mission::FileError with place and remedy.
DriveSettings read_drive_settings(setup::Settings&);

}  // namespace roci::sim::components
