// The table of the simulator's own component types.
#pragma once
#include "sim_svc/setup/registry.hpp"

namespace roci::sim::components {

/// Returns the types that come with the simulator: arm, camera, drive, dynamic_arm, grapple, gripper, radio, task.
/// README.md lists their settings.
setup::Registry standard_types();

}  // namespace roci::sim::components
