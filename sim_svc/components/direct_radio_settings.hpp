// This file reads the settings of a direct radio in mission and scenario files.
#pragma once
#include "sim_svc/components/direct_radio.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a direct radio (README.md). Throws mission::FileError with place and remedy.
DirectRadioSettings read_direct_radio_settings(setup::Settings&);

}  // namespace roci::sim::components
