// The costmap says where the rover may go, and how hard it is: the site seen with the limits of the rover.
#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/site.hpp"
#include "pathplan_svc/read_set.hpp"

namespace roci::pathplan {

/// Says what the rover can bear. Radii and heights are in metres.
struct RoverLimits {
  double radius = 0.8;           ///< of the circle around the rover, whatever its heading
  double max_slope = 0.35;       ///< radians, of the plane under the rover
  double rock_clearance = 0.25;  ///< rocks above this height are obstacles
  double max_roughness = 0.30;   ///< largest distance of the ground from the plane under the rover
  /// Bounds the difference of elevation between a cell and one that shares a side with it; 0: no limit. On a slope
  /// that is allowed the difference is up to tan(max_slope) times the side of a cell.
  double max_step = 0;
};

/// Describes an obstacle known at run time or a keep-out zone of the mission, in metres.
struct Disc {
  terrain::Point centre;
  double radius = 0;
  bool operator==(const Disc&) const = default;
};

/// Says why a cell may not be entered. A `margin` cell is nearer than the rover's radius to a rock, a disc, a
/// keep-out zone, unknown ground or the edge of the map; the centre of a `disc` cell lies in a disc, that of a
/// `keep_out` cell in a polygon.
enum class CellState : std::uint8_t { free, margin, steep, rough, step, rock, unknown, disc, keep_out };

/// Returns the name above.
const char* to_string(CellState state);

/// Says where the rover's centre may be, and what the ground there is like. Tilt and roughness come from a
/// plane fitted to the cells under the rover, as in Goldberg, Maimone, Matthies, "Stereo vision and rover
/// navigation software for planetary exploration", IEEE Aerospace 2002.
///
/// A verdict is sound for the whole cell, not for its centre alone: each point of a free cell keeps the
/// rover's radius from every occupied cell, unknown cell, disc and keep-out zone. A cell blocked for its slope,
/// roughness or step blocks the rover's centre only. Unknown ground is never free.
class Costmap {
 public:
  /// Bounds the rover's radius by the side of a cell: the plane under a rover of so many is fitted to 40,401 of them.
  static constexpr double kMostRadiusCells = 100;

  /// Fits the map to the site, with its keep-out zones and those given. Throws std::invalid_argument for limits that
  /// are not positive and finite (the step's may be zero), and for a radius of more than kMostRadiusCells.
  Costmap(const terrain::Site& site, const RoverLimits& limits,
          const std::vector<terrain::Polygon>& keep_out = {});

  const terrain::Grid& grid() const { return grid_; }
  const RoverLimits& limits() const { return limits_; }

  /// Returns a number that grows with each change of state() or may_be_free() of a cell, from 1 on if nothing else is
  /// said.
  std::uint64_t version() const { return version_; }
  /// Sets the first version; it is to be called before the first change.
  void count_versions_from(std::uint64_t first) { version_ = first; }

  CellState state(std::size_t index) const { return state_[index]; }
  CellState state(terrain::Cell c) const {
    if (reads_ != nullptr) reads_->add(c);
    return state_[grid_.index(c)];
  }
  bool is_free(terrain::Cell c) const { return grid_.contains(c) && state(c) == CellState::free; }
  bool is_free(terrain::Point p) const {
    return grid_.contains(p) && state(grid_.cell_of(p)) == CellState::free;
  }

  /// Returns the number of cells whose ground the site does not know.
  std::size_t unknown_cells() const { return unknown_cells_; }
  /// Tells whether the cell would be free if all unknown ground were good ground; a free cell would.
  bool may_be_free(std::size_t index) const {
    return state_[index] == CellState::free || (unknown_cells_ > 0 && if_known_[index] == CellState::free);
  }

  /// Notes in a set which cells are asked about one by one (state(Cell) and is_free()), for as long as it lives. One at
  /// a time; the map must outlive it and stay where it is.
  class Recording {
   public:
    Recording(const Costmap& map, ReadSet& reads) : map_(map) { map_.reads_ = &reads; }
    ~Recording() { map_.reads_ = nullptr; }
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

   private:
    const Costmap& map_;
  };

  /// Returns the gradient of the fitted plane.
  terrain::Gradient gradient(std::size_t index) const { return {east_[index], north_[index]}; }
  /// Returns the roughness, from 0 for smooth to 1 for the roughest that is allowed.
  double roughness(std::size_t index) const { return roughness_[index]; }

  /// Lets these discs and no others block from now on. Returns whether state() or may_be_free() of any cell changed,
  /// which makes a new version. Throws std::invalid_argument for a centre that is not finite or a radius that is
  /// negative or not finite; the map is then as before.
  bool set_discs(const std::vector<Disc>& discs);
  /// Returns the cells that the newest version changed, by index.
  const std::vector<std::size_t>& changed_cells() const { return changed_; }

 private:
  void fit_planes(const terrain::Site& site);
  void mark_steps(const terrain::Site& site);
  void mark_rocks(const terrain::Site& site);
  void mark_unknown(const terrain::Site& site);
  void mark_margin_of(terrain::Cell blocked);
  void mark_edge();
  void mark_disc(const Disc& disc);
  void mark_polygon(const terrain::Polygon& polygon);
  void raise(terrain::Cell c, CellState state);

  terrain::Grid grid_;
  RoverLimits limits_;
  std::uint64_t version_ = 1;
  std::vector<CellState> terrain_state_;  // without discs
  std::vector<CellState> state_;
  // The same as if all unknown ground were good; empty where there is none.
  std::vector<CellState> terrain_if_known_;
  std::vector<CellState> if_known_;
  std::size_t unknown_cells_ = 0;
  std::vector<std::size_t> changed_;
  mutable ReadSet* reads_ = nullptr;
  std::vector<float> east_;
  std::vector<float> north_;
  std::vector<float> roughness_;
};

}  // namespace roci::pathplan
