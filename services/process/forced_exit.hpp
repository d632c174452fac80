// A forced exit is the last resort of a process whose transport does not let go of it (docs/dds.md, "An open
// fault of Fast DDS").
#pragma once

#include <chrono>
#include <string>

namespace roci::services::process {

/// Bounds the wait for the end of a process that has nothing left to do.
inline constexpr std::chrono::seconds kExitLimit{3};

/// Ends this process with `code`, the one that it would have ended with, unless it has ended by itself within
/// `limit` of wall time; `last_words` go to standard error then. Destructors and exit handlers do not run:
/// call it when nothing is left to be saved.
void force_exit_after(std::chrono::milliseconds limit, int code, std::string last_words);

}  // namespace roci::services::process
