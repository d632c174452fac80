// This file says of straight pieces of a path over the costmap whether they are free, and what they cost.
#pragma once
#include <vector>

#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/drive_model.hpp"

namespace roci::pathplan {

using Polyline = std::vector<terrain::Point>;

/// Says what a straight drive costs, without turns: the sum over the cells that it crosses, exact for ground
/// that is a plane in each cell.
struct SegmentCost {
  bool free = true;   ///< No cell on the way is blocked.
  double length = 0;  ///< m, horizontal
  double time = 0;    ///< s
  double energy = 0;  ///< J
};

/// Measures the drive. Both ends must lie on the map.
SegmentCost measure(const Costmap& map, const DriveModel& drive, terrain::Point from, terrain::Point to);

/// Returns SegmentCost::time of the drive alone, to the last bit, which is cheaper.
double drive_time(const Costmap& map, const DriveModel& drive, terrain::Point from, terrain::Point to);

/// Makes the test alone, which is cheaper: it stops at the first blocked cell.
bool is_free(const Costmap& map, terrain::Point from, terrain::Point to);

/// Returns the state of greatest hindrance among the cells that the straight line crosses, in the order of
/// CellState.
CellState worst_state(const Costmap& map, terrain::Point from, terrain::Point to);

/// Measures a drive along a polyline with turns on the spot at its corners. The heading at the start is not
/// known: it counts as a turn by a right angle, the mean over all headings. A polyline of a single point
/// costs nothing.
SegmentCost measure(const Costmap& map, const DriveModel& drive, const Polyline& path);

/// Returns radians, -pi … pi, from due east counter-clockwise.
double heading(terrain::Point from, terrain::Point to);
/// Returns the size of the turn between two headings, 0 … pi.
double turn_between(double heading_before, double heading_after);
/// Stands for the turn of unknown size at the start, in radians.
inline constexpr double kFirstTurn = 1.5707963267948966;

/// Returns the same line with intermediate points, so that neighbours are at most `spacing` metres apart.
Polyline densify(const Polyline& path, double spacing);

}  // namespace roci::pathplan
