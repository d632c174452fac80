// This file reads the section `watch` of a mission file: goals that states of timelines raise.
#pragma once
#include <vector>

#include "core/mission/entry.hpp"
#include "science_svc/watch/watch.hpp"

namespace roci::science::watch {

/// Reads the section `watch` of mission.yaml; a mission without it watches nothing. Throws mission::FileError with
/// place and remedy.
std::vector<Rule> read_rules(const mission::Entry& mission);

}  // namespace roci::science::watch
