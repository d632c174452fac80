// Polygons are closed figures on the map, such as the ground that nobody may enter.
#pragma once

#include <vector>

#include "core/terrain/grid.hpp"

namespace roci::terrain {

/// Holds a closed outline through at least three corners, in metres; the last corner is joined to the first.
/// Where it crosses itself, a point is inside by the even-odd rule.
struct Polygon {
  std::vector<Point> corners;
  bool operator==(const Polygon&) const = default;
};

/// Tells whether the point lies inside (Shimrat, "Algorithm 112: position of point relative to polygon",
/// Communications of the ACM 5(8), 1962). A point of the outline counts as either.
bool contains(const Polygon& polygon, Point p);

/// Returns the metres from the point to the outline, whether it lies inside or outside.
double distance_to_outline(const Polygon& polygon, Point p);

}  // namespace roci::terrain
