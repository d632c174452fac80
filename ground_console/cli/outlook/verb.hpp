// These are the verbs `roci downlinks`, `utility`, `energy`, `subway` and `chains`.
#pragma once

#include <string>

#include "ground_console/lib/client.hpp"

namespace roci::console::cli::outlook {

/// Says which of the verbs is meant.
enum class Subject { downlinks, utility, energy, subway, chains };

/// Holds the arguments of these verbs.
struct OutlookArguments {
  Subject subject = Subject::downlinks;
  std::string robot;  ///< empty: the only one, or the first by name
  std::string svg;    ///< the file to write; empty: text or JSON is printed
};

/// Prints the newest that the robot's planner has told, or writes its picture. Returns an exit code
/// (docs/exit-codes.md, "Ground tool"): 1 where no planner tells it, with the reason on standard error; a file that
/// cannot be written throws std::invalid_argument.
int show_outlook(lib::Client& client, const OutlookArguments& arguments, bool json);

}  // namespace roci::console::cli::outlook
