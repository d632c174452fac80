/// Where the rover may go, and how hard it is: the site seen with the limits of the rover.
#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/site.hpp"

namespace roci::pathplan {

/// Says what the rover can bear. Radii and heights are in metres.
struct RoverLimits {
  double radius = 0.8;           ///< of the circle around the rover, whatever its heading
  double max_slope = 0.35;       ///< radians, of the plane under the rover
  double rock_clearance = 0.25;  ///< rocks above this height are obstacles
  double max_roughness = 0.30;   ///< largest distance of the ground from the plane under the rover
};

/// Is an obstacle known at run time or a keep-out zone of the mission, in metres.
struct Disc {
  terrain::Point centre;
  double radius = 0;
  bool operator==(const Disc&) const = default;
};

/// Says why a cell may not be entered. A `margin` cell is nearer than the rover's radius to a rock, a disc or
/// the edge of the map; the centre of a `disc` cell lies in a disc.
enum class CellState : std::uint8_t { free, margin, steep, rough, rock, unknown, disc };

/// Returns the name above.
const char* to_string(CellState state);

/// Says where the rover's centre may be, and what the ground there is like. Tilt and roughness come from a
/// plane fitted to the cells under the rover, as in Goldberg, Maimone, Matthies, "Stereo vision and rover
/// navigation software for planetary exploration", IEEE Aerospace 2002.
///
/// A verdict is sound for the whole cell, not for its centre alone: each point of a free cell keeps the
/// rover's radius from every occupied cell and disc. A cell blocked for its slope blocks the rover's centre
/// only.
class Costmap {
 public:
  /// Fits the map to the site. Throws std::invalid_argument for limits that are not positive and finite.
  Costmap(const terrain::Site& site, const RoverLimits& limits);

  const terrain::Grid& grid() const { return grid_; }
  const RoverLimits& limits() const { return limits_; }

  /// Returns a number that starts at 1 and grows with each change of a cell.
  std::uint64_t version() const { return version_; }

  CellState state(std::size_t index) const { return state_[index]; }
  CellState state(terrain::Cell c) const { return state_[grid_.index(c)]; }
  bool is_free(terrain::Cell c) const { return grid_.contains(c) && state(c) == CellState::free; }
  bool is_free(terrain::Point p) const {
    return grid_.contains(p) && state(grid_.cell_of(p)) == CellState::free;
  }

  /// Returns the gradient of the fitted plane.
  terrain::Gradient gradient(std::size_t index) const { return {east_[index], north_[index]}; }
  /// Returns the roughness, from 0 for smooth to 1 for the roughest that is allowed.
  double roughness(std::size_t index) const { return roughness_[index]; }

  /// Lets these discs and no others block from now on. Returns whether any cell changed, which makes a new
  /// version. Throws std::invalid_argument for a centre that is not finite or a radius that is negative or
  /// not finite; the map is then as before.
  bool set_discs(const std::vector<Disc>& discs);

 private:
  void fit_planes(const terrain::Site& site);
  void mark_rocks(const terrain::Site& site);
  void mark_margin_of(terrain::Cell blocked);
  void mark_edge();
  void mark_disc(const Disc& disc);
  void raise(terrain::Cell c, CellState state);

  terrain::Grid grid_;
  RoverLimits limits_;
  std::uint64_t version_ = 1;
  std::vector<CellState> terrain_state_;  // without discs
  std::vector<CellState> state_;
  std::vector<float> east_;
  std::vector<float> north_;
  std::vector<float> roughness_;
};

}  // namespace roci::pathplan
