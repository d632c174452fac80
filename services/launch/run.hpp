// A run takes a mission on this host from the first process to the summary.
#pragma once

#include <functional>

#include "services/launch/options.hpp"

namespace roci::services::launch {

/// Says how a run ended; docs/exit-codes.md lists these under "Runs".
enum ExitCode { kAchieved = 0, kNotAchieved = 1, kBadInput = 2, kServiceFailed = 3 };

/// Flies the mission and prints the outcome. `stop_asked` tells how often the user has asked for the end so
/// far. Throws transport::TransportError and std::system_error when the run cannot begin.
ExitCode fly(Options, const std::function<int()>& stop_asked);

}  // namespace roci::services::launch
