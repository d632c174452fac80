#include "core/terrain/polygon_file.hpp"

namespace roci::terrain {

Polygon read_polygon(const mission::Entry& entry) {
  entry.allow_only({"polygon"});
  const mission::Entry corners = entry.at("polygon");
  Polygon polygon;
  for (const mission::Entry& corner : corners.items()) {
    const std::vector<mission::Entry> numbers = corner.items();
    if (numbers.size() != 2) corner.fail("a corner must be [x, y], metres of the map frame");
    polygon.corners.push_back({numbers[0].number(), numbers[1].number()});
  }
  if (polygon.corners.size() < 3) {
    corners.fail("'polygon' needs at least three corners, e.g. [[10, 10], [20, 10], [20, 20]]");
  }
  return polygon;
}

}  // namespace roci::terrain
