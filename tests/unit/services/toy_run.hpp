// Four services that write, set timers and call each other at random, from a seed: what they received, in
// order, is the run's trace. Under the simulated clock the trace depends on the seed alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/node.hpp"

namespace roci::services {

// One line for each thing that a handler of the service saw.
using Trace = std::vector<std::string>;

// The trace of the whole run, service by service. `transports`: one vendor for each of the four.
Trace toy_run(std::uint64_t seed, const std::vector<std::string>& transports, int domain);

}  // namespace roci::services
