// The stimuli of a scenario file say what happens in a run, and when.
#pragma once
#include <vector>

#include "sim_svc/scenario/scenario.hpp"
#include "sim_svc/setup/roster_file.hpp"

namespace roci::sim::scenario {

/// Reads the list `stimuli` of a scenario (README.md), in order of time. Throws mission::FileError.
std::vector<Stimulus> read_stimuli(const mission::Entry& list, temporal::Duration duration,
                                   const setup::Roster&);

}  // namespace roci::sim::scenario
