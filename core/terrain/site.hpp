#pragma once
#include <cstdint>
#include <vector>

#include "core/terrain/grid.hpp"

namespace roci::terrain {

enum class Occupancy : std::uint8_t { free, unknown, occupied };

/// The rise per metre towards east and north.
struct Gradient {
  double east = 0;
  double north = 0;
};

/// The layers of a site, each with grid.cell_count() values by rows from the south.
struct SiteLayers {
  std::vector<float> elevation;      ///< Metres, at the centre of the cell.
  std::vector<float> rock_height;    ///< Metres of the tallest rock in the cell, 0 where there is none.
  std::vector<Occupancy> occupancy;  ///< What a map_server reader makes of the cell.
};

/// The terrain of a mission as values: it is immutable once built, and safe to read from several threads.
class Site {
 public:
  /// Throws MapError when the grid is empty or a layer has the wrong size or a value that is not finite.
  Site(Grid grid, SiteLayers layers);

  const Grid& grid() const { return grid_; }
  const SiteLayers& layers() const { return layers_; }

  /// Interpolates bilinearly between the centres of cells, in metres; outside the outermost centres the value
  /// of the border.
  double elevation(Point p) const;
  double elevation(Cell c) const { return layers_.elevation[grid_.index(c)]; }

  /// Takes central differences (one-sided at the border) at the centre of the cell.
  Gradient gradient(Cell c) const;
  /// Interpolates bilinearly between the gradients of cells.
  Gradient gradient(Point p) const;
  /// Returns the angle of steepest ascent in radians, 0 … π/2.
  double slope(Point p) const;

  /// Returns metres; 0 outside the map.
  double rock_height(Point p) const;
  double rock_height(Cell c) const { return layers_.rock_height[grid_.index(c)]; }
  /// Is `unknown` outside the map.
  Occupancy occupancy(Point p) const;
  Occupancy occupancy(Cell c) const { return layers_.occupancy[grid_.index(c)]; }

 private:
  Grid grid_;
  SiteLayers layers_;
};

}  // namespace roci::terrain
