// This is the verb `roci watch`.
#pragma once

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/client.hpp"

namespace roci::console::cli::watch {

/// Shows the live view on a terminal until the mission ends, q or Ctrl-C; with `json`, prints a line of status
/// each second instead. `closing_matters`: the code is kStillOpen if it ends before the mission. Returns an exit code
/// (docs/exit-codes.md, "Ground tool").
int watch(lib::Client& client, const MissionWords& words, bool closing_matters, bool json);

}  // namespace roci::console::cli::watch
