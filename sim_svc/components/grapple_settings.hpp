// This file reads the slots and modules of a grapple's world from the files of a mission.
#pragma once

#include "sim_svc/components/grapple.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::components {

/// Reads the settings of a component of type `grapple` (README.md) with what the scenario's start changes of them.
/// Every slot has a pose and every module a slot of its own in what it returns. Throws mission::FileError.
GrappleSettings read_grapple_settings(setup::Settings&);

}  // namespace roci::sim::components
