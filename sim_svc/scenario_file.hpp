#pragma once
#include <vector>

#include "core/mission/entry.hpp"
#include "sim_svc/scenario.hpp"

namespace roci::sim {

/// Reads a whole scenario file (README.md, "Scenarios"). Throws mission::FileError with place and remedy.
Scenario read_scenario(const mission::Entry& root);

/// Reads the list `windows` of a mission or a scenario: entries with `timeline` and `open`, a list of
/// [opens, closes] in seconds, ascending.
std::vector<Window> read_windows(const mission::Entry& list);

}  // namespace roci::sim
