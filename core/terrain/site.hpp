#pragma once
#include <cstdint>
#include <vector>

#include "core/terrain/grid.hpp"

namespace roci::terrain {

enum class Occupancy : std::uint8_t { free, unknown, occupied };

// Rise per metre towards east and north.
struct Gradient {
  double east = 0;
  double north = 0;
};

// The layers of a site, each with grid.cell_count() values by rows from the south.
struct SiteLayers {
  std::vector<float> elevation;      // metres, at the centre of the cell
  std::vector<float> rock_height;    // metres, tallest rock in the cell, 0 where there is none
  std::vector<Occupancy> occupancy;  // what a map_server reader makes of the cell
};

// Terrain of a mission as values: immutable once built, safe to read from several threads.
class Site {
 public:
  // Throws MapError when the grid is empty or a layer has the wrong size or a value that is not finite.
  Site(Grid grid, SiteLayers layers);

  const Grid& grid() const { return grid_; }
  const SiteLayers& layers() const { return layers_; }

  // Bilinear between the centres of cells, metres; outside the outermost centres the value of the border.
  double elevation(Point p) const;
  double elevation(Cell c) const { return layers_.elevation[grid_.index(c)]; }

  // Central differences (one-sided at the border) at the centre of the cell.
  Gradient gradient(Cell c) const;
  // Bilinear between the gradients of cells.
  Gradient gradient(Point p) const;
  // Angle of steepest ascent, radians, 0 … π/2.
  double slope(Point p) const;

  // Metres; 0 outside the map.
  double rock_height(Point p) const;
  double rock_height(Cell c) const { return layers_.rock_height[grid_.index(c)]; }
  // `unknown` outside the map.
  Occupancy occupancy(Point p) const;
  Occupancy occupancy(Cell c) const { return layers_.occupancy[grid_.index(c)]; }

 private:
  Grid grid_;
  SiteLayers layers_;
};

}  // namespace roci::terrain
