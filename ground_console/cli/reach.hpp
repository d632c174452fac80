// This is the verb `roci reach`: whether a robot gets to a place, how long it takes, and how much energy.
#pragma once

#include <optional>
#include <string>

#include "ground_console/lib/client.hpp"

namespace roci::console::cli {

/// Holds the arguments of `roci reach`.
struct ReachArguments {
  double x_m = 0;
  double y_m = 0;
  std::optional<double> from_x_m;  ///< where the way begins; by default where the robot is
  std::optional<double> from_y_m;
  std::string robot;    ///< empty: the only one that is observed
  std::string service;  ///< that is asked; empty: path_planner_of()
};

/// Returns the path planner to ask: the given one, else the robot's own, else the only one that tells of its map, else
/// pathplan_svc. Throws std::invalid_argument, which lists them, where several could be meant.
std::string path_planner_of(const lib::MissionView& view, const ReachArguments& arguments);

/// Asks the mission's path planner, and changes nothing. Returns an exit code: there is a way,
/// or there is none (kRefused).
int show_reach(lib::Client& client, const ReachArguments& arguments, bool json);

}  // namespace roci::console::cli
