#include "core/terrain/site.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {
namespace {

// Holds the four cells whose centres surround a point, and how far between them the point lies (0 … 1).
struct Patch {
  Cell low;
  Cell high;
  double east;
  double north;
};

Patch patch_of(const Grid& grid, Point p) {
  const double x = std::clamp((p.x - grid.origin.x) / grid.resolution - 0.5, 0.0, grid.columns - 1.0);
  const double y = std::clamp((p.y - grid.origin.y) / grid.resolution - 0.5, 0.0, grid.rows - 1.0);
  const Cell low{static_cast<int>(x), static_cast<int>(y)};
  const Cell high{std::min(low.column + 1, grid.columns - 1), std::min(low.row + 1, grid.rows - 1)};
  return {low, high, x - low.column, y - low.row};
}

double blend(const Patch& patch, double south_west, double south_east, double north_west, double north_east) {
  const double south = south_west + (south_east - south_west) * patch.east;
  const double north = north_west + (north_east - north_west) * patch.east;
  return south + (north - south) * patch.north;
}

void require_finite(const std::vector<float>& layer, const Grid& grid, const char* name) {
  if (layer.size() != grid.cell_count()) {
    throw MapError(std::string("layer ") + name + " has " + std::to_string(layer.size()) +
                   " cells, the grid " + std::to_string(grid.cell_count()));
  }
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (std::isfinite(layer[i])) continue;
    const Cell c = grid.cell_at(i);
    throw MapError(std::string("layer ") + name + " is not finite at column " + std::to_string(c.column) +
                   ", row " + std::to_string(c.row) + "; fill the hole");
  }
}

}  // namespace

Site::Site(Grid grid, SiteLayers layers) : grid_(grid), layers_(std::move(layers)) {
  if (grid_.columns < 1 || grid_.rows < 1 || !(grid_.resolution > 0) || !std::isfinite(grid_.resolution)) {
    throw MapError("a site needs at least one cell and a positive resolution");
  }
  require_finite(layers_.elevation, grid_, "elevation");
  require_finite(layers_.rock_height, grid_, "rock_height");
  if (layers_.occupancy.size() != grid_.cell_count()) throw MapError("layer occupancy does not fit the grid");
}

double Site::elevation(Point p) const {
  const Patch q = patch_of(grid_, p);
  return blend(q, elevation(q.low), elevation(Cell{q.high.column, q.low.row}),
               elevation(Cell{q.low.column, q.high.row}), elevation(q.high));
}

Gradient Site::gradient(Cell c) const {
  const int west = std::max(c.column - 1, 0);
  const int east = std::min(c.column + 1, grid_.columns - 1);
  const int south = std::max(c.row - 1, 0);
  const int north = std::min(c.row + 1, grid_.rows - 1);
  const auto rise = [this](Cell from, Cell to, int cells) {
    return cells == 0 ? 0.0 : (elevation(to) - elevation(from)) / (cells * grid_.resolution);
  };
  return {rise({west, c.row}, {east, c.row}, east - west),
          rise({c.column, south}, {c.column, north}, north - south)};
}

Gradient Site::gradient(Point p) const {
  const Patch q = patch_of(grid_, p);
  const Gradient sw = gradient(q.low);
  const Gradient se = gradient(Cell{q.high.column, q.low.row});
  const Gradient nw = gradient(Cell{q.low.column, q.high.row});
  const Gradient ne = gradient(q.high);
  return {blend(q, sw.east, se.east, nw.east, ne.east), blend(q, sw.north, se.north, nw.north, ne.north)};
}

double Site::slope(Point p) const {
  const Gradient g = gradient(p);
  return std::atan(std::sqrt(g.east * g.east + g.north * g.north));
}

double Site::rock_height(Point p) const { return grid_.contains(p) ? rock_height(grid_.cell_of(p)) : 0.0; }

Occupancy Site::occupancy(Point p) const {
  return grid_.contains(p) ? occupancy(grid_.cell_of(p)) : Occupancy::unknown;
}

}  // namespace roci::terrain
