// Permissions bound what the executive does by itself.
#pragma once

#include <set>
#include <string>

namespace roci::exec::executive {

/// Holds what the ground lets the executive do by itself; without orders that is everything.
struct Permissions {
  bool held = false;                        ///< no activity starts
  bool each_approved = false;               ///< of commands, only what is approved starts
  bool recovers = true;                     ///< retries and contingencies are used
  std::set<std::string> held_activities{};  ///< these do not start
  std::set<std::string> approved{};

  /// Returns in plain words why the activity may not start, or an empty text if it may. Its latest start
  /// passes all the same.
  std::string refusal(const std::string& activity, bool commands) const {
    if (held || held_activities.contains(activity)) return "held by the ground";
    if (each_approved && commands && !approved.contains(activity)) return "waits for the ground's approval";
    return "";
  }
};

}  // namespace roci::exec::executive
