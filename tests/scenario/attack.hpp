// What the tests of attacks share: the scripts that they run, and the physical effects that these print.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {

// Runs a script of this folder on the programs of the build and the planetary mission, in a domain of its own.
Ended attack(const std::string& script, const std::string& dds);

// What was really done (effects.hpp), as one array.
nlohmann::json effects_in(const std::string& output);

}  // namespace roci::scenario
