// A path outcome says what became of a search for a path.
#pragma once
#include <cstdint>

#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/segment.hpp"

namespace roci::pathplan {

/// Says whether there is a path, or why not.
enum class PathStatus : std::uint8_t {
  found,
  unreachable,  ///< It is proved: the ends lie in regions of free cells that do not meet, whatever unknown ground is like.
  unknown,        ///< Known ground has no path, and one may lead over ground that the map does not know.
  start_outside,  ///< The start lies outside the map.
  goal_outside,
  start_blocked,  ///< PathOutcome::blocked_by says by what.
  goal_blocked,
};

/// Returns the name above.
const char* to_string(PathStatus status);

/// Holds way-points from start to goal (both included), at most PlannerSettings::waypoint_spacing apart, and
/// what the drive costs (segment.hpp). It is empty and zero unless found.
struct PathOutcome {
  PathStatus status = PathStatus::found;
  CellState blocked_by = CellState::free;
  Polyline waypoints{};
  double length = 0;  ///< m
  double time = 0;    ///< s
  double energy = 0;  ///< J
};

}  // namespace roci::pathplan
