// A site is the terrain of a mission: elevation, rocks and occupancy on one grid.
#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/grid.hpp"
#include "core/terrain/polygon.hpp"

namespace roci::terrain {

/// Says whether a cell of the map is free, as a map_server reader takes it.
enum class Occupancy : std::uint8_t { free, unknown, occupied };

/// Holds the rise per metre towards east and north.
struct Gradient {
  double east = 0;
  double north = 0;
};

/// Holds the layers of a site, each with grid.cell_count() values by rows from the south.
struct SiteLayers {
  std::vector<float> elevation;      ///< metres, at the centre of the cell
  std::vector<float> rock_height;    ///< height of the tallest rock in the cell, m, or 0
  std::vector<Occupancy> occupancy;  ///< what a map_server reader makes of the cell
  std::vector<Polygon> keep_out{};   ///< ground that nobody may enter; it may reach beyond the map
};

/// Holds the terrain of a mission as values: it is immutable once built, and safe to read from several
/// threads.
class Site {
 public:
  /// Takes the layers of a grid. Throws MapError when the grid is empty or a layer has the wrong size or a
  /// value that is not finite.
  Site(Grid grid, SiteLayers layers);

  const Grid& grid() const { return grid_; }
  const SiteLayers& layers() const { return layers_; }
  const std::vector<Polygon>& keep_out() const { return layers_.keep_out; }

  /// Returns metres, interpolated bilinearly between the centres of cells; outside the outermost centres it
  /// is the value of the border.
  double elevation(Point p) const;
  double elevation(Cell c) const { return layers_.elevation[grid_.index(c)]; }

  /// Takes central differences (one-sided at the border) at the centre of the cell.
  Gradient gradient(Cell c) const;
  /// Interpolates bilinearly between the gradients of cells.
  Gradient gradient(Point p) const;
  /// Returns the angle of steepest ascent in radians, 0 … π/2.
  double slope(Point p) const;

  /// Returns the height of the rock there in metres; it is 0 outside the map.
  double rock_height(Point p) const;
  double rock_height(Cell c) const { return layers_.rock_height[grid_.index(c)]; }
  /// Returns what is there; it is `unknown` outside the map.
  Occupancy occupancy(Point p) const;
  Occupancy occupancy(Cell c) const { return layers_.occupancy[grid_.index(c)]; }

 private:
  Grid grid_;
  SiteLayers layers_;
};

}  // namespace roci::terrain
