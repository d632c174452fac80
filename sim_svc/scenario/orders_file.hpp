// This file reads orders of the ground in a scenario's stimuli (docs/orders.md).
#pragma once

#include "core/mission/entry.hpp"
#include "sim_svc/scenario/scenario.hpp"

namespace roci::sim::scenario {

/// Reads `set: {issuer, id, robot, timeline, value}`. As `roci order set` reads it: a truth, a number, or the name of a
/// state. Throws mission::FileError.
OrderStimulus read_set(const mission::Entry& entry);

/// Reads `order: {issuer, id, robot, kind, …}`, with the arguments of the kind. Throws mission::FileError.
OrderStimulus read_order(const mission::Entry& entry);

}  // namespace roci::sim::scenario
