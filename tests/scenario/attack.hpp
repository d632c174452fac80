// What the tests of attacks share: the scripts that they run, and the physical effects that these print.
#pragma once

#include <map>
#include <string>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {

// Runs a script of this folder on the programs of the build and the planetary mission, in a domain of its own.
Ended attack(const std::string& script, const std::string& dds);

// How often each thing was really done: "kind object by activity attempt" → count.
std::map<std::string, int> effects_in(const std::string& output);
// The same with the epoch of issue behind each: "kind object by activity attempt of epoch" → count.
std::map<std::string, int> effects_by_epoch_in(const std::string& output);

}  // namespace roci::scenario
