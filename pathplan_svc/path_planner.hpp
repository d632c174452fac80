#pragma once
#include <cstdint>
#include <map>
#include <utility>

#include "pathplan_svc/corridor_planner.hpp"
#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/drive_model.hpp"
#include "pathplan_svc/grid_search.hpp"

namespace roci::pathplan {

/// Says whether there is a path, or why not.
enum class PathStatus : std::uint8_t {
  found,
  unreachable,    ///< It is proved: the ends lie in regions of free cells that do not meet.
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
  Polyline waypoints;
  double length = 0;  ///< m
  double time = 0;    ///< s
  double energy = 0;  ///< J
};

/// Bounds the work of a planner and shapes its way-points.
struct PlannerSettings {
  CorridorSettings corridor;
  double waypoint_spacing = 4.0;  ///< m
  double max_piece = 60.0;        ///< Shortcuts try no longer straight piece, m.
  std::size_t max_corners = 60;   ///< Bounds a path before shortcuts.
};

/// Finds fast drives over a map that may gain obstacles. An answer depends on the map and the two ends alone,
/// never on earlier questions; answers and search trees are kept until the map changes. One thread may use it
/// at a time.
///
/// A goal must be free. A start in the margin of an obstacle (one that was seen while the rover stood there)
/// is left by the shortest straight line to a free cell.
class PathPlanner {
 public:
  PathPlanner(const terrain::Site& site, const RoverLimits& limits, const DriveModel& drive,
              const PlannerSettings& settings = {});

  const Costmap& map() const { return map_; }
  const DriveModel& drive() const { return drive_; }

  /// Does what Costmap::set_discs does.
  bool set_discs(const std::vector<Disc>& discs);

  PathOutcome path(terrain::Point from, terrain::Point to);

 private:
  PathOutcome plan(terrain::Point from, terrain::Point to);
  // Takes ends that are both free and in one region. The result is never slower than the exact way over the
  // grid, turns included.
  Polyline fastest(terrain::Point from, terrain::Point to);
  const SearchTree& tree_from(terrain::Cell source);
  PathOutcome finish(const Polyline& corners) const;

  Costmap map_;
  DriveModel drive_;
  PlannerSettings settings_;
  GridSearch search_;
  Regions regions_;
  std::map<std::size_t, SearchTree> trees_;
  std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, PathOutcome> answers_;
};

}  // namespace roci::pathplan
