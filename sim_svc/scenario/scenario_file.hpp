// This file reads a scenario.
#pragma once
#include <vector>

#include "core/mission/entry.hpp"
#include "sim_svc/scenario/scenario.hpp"
#include "sim_svc/setup/roster_file.hpp"

namespace roci::sim::scenario {

/// Reads a whole scenario file (README.md, "Scenarios") for these robots. Throws mission::FileError with
/// place and remedy.
Scenario read_scenario(const mission::Entry& root, const setup::Roster&);

/// Reads the list `windows` of a mission or a scenario: entries with `timeline` and `open`, a list of
/// [opens, closes] in seconds, ascending.
std::vector<world::Window> read_windows(const mission::Entry& list);

}  // namespace roci::sim::scenario
