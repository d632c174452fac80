// One run of a mission on this host, from the first process to the summary.
#pragma once

#include <functional>

#include "services/launch/options.hpp"

namespace roci::services::launch {

// docs/exit-codes.md, "Runs".
enum ExitCode { kAchieved = 0, kNotAchieved = 1, kBadInput = 2, kServiceFailed = 3 };

// `stop_asked`: how often the user asked for the end so far. Prints the outcome. Throws
// services::TransportError and std::system_error when the run cannot begin.
ExitCode fly(Options, const std::function<int()>& stop_asked);

}  // namespace roci::services::launch
