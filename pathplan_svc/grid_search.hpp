// The grid search goes over the cells of the costmap: it finds what is connected, and the fastest drives from one
// cell to all others.
#pragma once
#include <cstdint>
#include <vector>

#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/segment.hpp"

namespace roci::pathplan {

/// Tells which free cells hang together: the proof that one place cannot be reached from another. Moves go to
/// the eight neighbours, diagonally only where both cells beside the move are free, too.
class Regions {
 public:
  /// Says which ground counts: what is free, or what would be if all unknown ground were good.
  enum class Ground : std::uint8_t { known, hoped_for };

  explicit Regions(const Costmap& map, Ground ground = Ground::known);

  /// Returns the number of the region of a free cell, from 1; 0 for a blocked one.
  std::uint32_t region(std::size_t index) const { return region_[index]; }
  std::size_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> region_;
  std::size_t count_ = 0;
};

/// Holds the fastest drives over the grid from one cell to every cell of its region (Dijkstra), exact for
/// moves between the centres of neighbouring cells and without turns.
class SearchTree {
 public:
  /// Returns the centres from the source to `target`, both included; none if there is no way.
  Polyline path_to(terrain::Cell target) const;
  bool reaches(terrain::Cell target) const { return move_[grid_.index(target)] != kNone; }
  /// Tells whether the way to `target` is still open on the map, which may have been given obstacles since the search.
  /// Then the way is the one that a new search would find: costs have only risen, and those on the way have not, so
  /// that nothing else became better or, where costs are equal, earlier.
  bool holds(const Costmap& map, terrain::Cell target) const;

 private:
  friend class GridSearch;
  static constexpr std::uint8_t kNone = 255;
  static constexpr std::uint8_t kSource = 254;

  terrain::Grid grid_;
  std::vector<std::uint8_t> move_;  // number of the move that enters the cell
};

/// Keeps the price of each move on the map; obstacles may be added to the map later, the ground stays.
class GridSearch {
 public:
  GridSearch(const Costmap& map, const DriveModel& drive);

  /// `map` is the one given at construction, with or without more obstacles. Equal costs are settled by the
  /// lower index of the cell, so the tree depends on the map and the source alone.
  SearchTree from(const Costmap& map, terrain::Cell source) const;

 private:
  // Holds the seconds from the centre to the border, by cell and by the eight directions.
  std::vector<float> half_move_;
};

}  // namespace roci::pathplan
