#include "core/terrain/holes.hpp"

#include <array>
#include <cmath>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {

std::size_t fill_holes(const Grid& grid, SiteLayers& layers) {
  std::vector<std::size_t> front;
  std::size_t holes = 0;
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    if (std::isfinite(layers.elevation[i])) {
      front.push_back(i);
    } else {
      layers.occupancy[i] = Occupancy::unknown;
      ++holes;
    }
  }
  if (holes == 0) return 0;
  if (front.empty())
    throw MapError("the map has no elevation anywhere: every cell is a hole; use another map");
  constexpr std::array<Cell, 4> kNeighbours{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  // A breadth-first fill from all known cells at once; the order of cells settles what is equally near.
  for (std::size_t next = 0; next < front.size(); ++next) {
    const Cell here = grid.cell_at(front[next]);
    for (const Cell& step : kNeighbours) {
      const Cell c{here.column + step.column, here.row + step.row};
      if (!grid.contains(c) || std::isfinite(layers.elevation[grid.index(c)])) continue;
      layers.elevation[grid.index(c)] = layers.elevation[front[next]];
      front.push_back(grid.index(c));
    }
  }
  return holes;
}

}  // namespace roci::terrain
