#include "core/terrain/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace roci::terrain {
namespace {

double distance_to_edge(Point a, Point b, Point p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
  const double share = std::clamp(along, 0.0, 1.0);
  return distance(p, {a.x + share * dx, a.y + share * dy});
}

}  // namespace

bool contains(const Polygon& polygon, Point p) {
  bool inside = false;
  const std::size_t n = polygon.corners.size();
  for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
    const Point a = polygon.corners[i];
    const Point b = polygon.corners[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

double distance_to_outline(const Polygon& polygon, Point p) {
  double nearest = std::numeric_limits<double>::infinity();
  const std::size_t n = polygon.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    nearest = std::min(nearest, distance_to_edge(polygon.corners[i], polygon.corners[(i + 1) % n], p));
  }
  return nearest;
}

}  // namespace roci::terrain
