// This is the table of the simulator's own component types.
#pragma once
#include "sim_svc/setup/registry.hpp"

namespace roci::sim::components {

/// Returns all types of the table in README.md, each with the reader of its settings.
setup::Registry standard_types();

}  // namespace roci::sim::components
