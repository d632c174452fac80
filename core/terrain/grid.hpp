// Positions are in metres, and cells belong to a square grid in the map frame.
#pragma once

#include <cmath>
#include <cstddef>

namespace roci::terrain {

/// Holds a position in the map frame in metres: x points east, y north.
struct Point {
  double x = 0;
  double y = 0;
  bool operator==(const Point&) const = default;
};

/// Returns the distance in metres.
inline double distance(Point a, Point b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/// Names a cell: the column counts east and the row counts north, both from the south-west corner.
struct Cell {
  int column = 0;
  int row = 0;
  bool operator==(const Cell&) const = default;
};

/// Says where the square cells of a map lie. `origin` is the south-west corner of cell (0, 0), in metres;
/// `resolution` is the side of a cell, in metres. Layers are stored by rows, index(cell) = row * columns +
/// column.
struct Grid {
  int columns = 0;
  int rows = 0;
  double resolution = 1;
  Point origin;

  bool operator==(const Grid&) const = default;

  double width() const { return columns * resolution; }
  double height() const { return rows * resolution; }
  std::size_t cell_count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }

  bool contains(Cell c) const { return c.column >= 0 && c.row >= 0 && c.column < columns && c.row < rows; }
  /// Returns true exactly for the points whose cell_of() lies on the map; a NaN gives false.
  bool contains(Point p) const {
    const double column = std::floor((p.x - origin.x) / resolution);
    const double row = std::floor((p.y - origin.y) / resolution);
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }

  /// Returns the cell of a point, which lies outside the map if the point does. The point must be finite and
  /// within 2^31 cells.
  Cell cell_of(Point p) const {
    return {static_cast<int>(std::floor((p.x - origin.x) / resolution)),
            static_cast<int>(std::floor((p.y - origin.y) / resolution))};
  }
  Point centre(Cell c) const {
    return {origin.x + (c.column + 0.5) * resolution, origin.y + (c.row + 0.5) * resolution};
  }

  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(c.column);
  }
  Cell cell_at(std::size_t index) const {
    const auto width_in_cells = static_cast<std::size_t>(columns);
    return {static_cast<int>(index % width_in_cells), static_cast<int>(index / width_in_cells)};
  }
};

}  // namespace roci::terrain
