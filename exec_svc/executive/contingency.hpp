// A contingency is what is done about a failed activity before its plan is given up (R69, R70): commands
// from a template, sent at once and without a planner.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::executive {

/// Describes one command of a contingency's template.
struct ContingencyCommand {
  std::string owner;
  std::string subsystem;
  std::string command_name;
  std::vector<temporal::Property> arguments;  ///< {name}: the failed command's argument of that name
  std::string robot{};                        ///< whose subsystem; empty: the owner's only one
};

/// Describes a task that nobody requests: a failure makes an instance of it.
struct Contingency {
  std::string name;
  std::vector<ContingencyCommand> commands;  ///< one after the other
  /// Says whether the activity is tried again then, if its preconditions hold; else the plan is broken.
  bool retries = false;
  std::uint32_t times = 1;                             ///< bounds its uses for one activity
  temporal::Duration within = temporal::seconds(300);  ///< bounds the time of all its commands
};

}  // namespace roci::exec::executive
