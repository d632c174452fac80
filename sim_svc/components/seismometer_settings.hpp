// This file reads the settings of a seismometer in mission and scenario files.
#pragma once
#include "sim_svc/components/seismometer.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a seismometer (README.md). Throws mission::FileError with place and remedy.
SeismometerSettings read_seismometer_settings(setup::Settings&);

}  // namespace roci::sim::components
