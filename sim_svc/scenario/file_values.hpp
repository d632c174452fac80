// This file reads numbers, times and rocks as scenario files write them.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/world/environment.hpp"

namespace roci::sim::scenario {

/// Reads a number that is no less than `least`; throws mission::FileError.
double at_least(const mission::Entry&, double least);
/// Reads seconds of mission time, from 0 to 30 years; throws mission::FileError.
temporal::Time time_of(const mission::Entry&);
/// Reads x, y and radius, in metres; throws mission::FileError.
world::Rock read_rock(const mission::Entry&);

}  // namespace roci::sim::scenario
