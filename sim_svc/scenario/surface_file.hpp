// This file reads look and soil of the simulated ground in mission and scenario files.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/world/surface.hpp"

namespace roci::sim::scenario {

/// Reads `surface` of a mission's `simulation` or of a scenario's `world` (README.md): how the ground looks and what
/// soil lies where. What it says stands in place of what `surface` holds; the list `odd` is replaced as a whole.
/// Throws mission::FileError.
void read_surface(const mission::Entry&, world::Surface& surface);

}  // namespace roci::sim::scenario
