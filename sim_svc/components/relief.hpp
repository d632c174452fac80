// The relief is the simulated ground in the detail that a camera sees.
#pragma once
#include <cstdint>
#include <vector>

#include "core/terrain/site.hpp"
#include "sim_svc/world/environment.hpp"

namespace roci::sim::components {

/// Gives the share of light that soil returns, on average.
inline constexpr double kSoilAlbedo = 0.42;

/// Shows the ground as a camera sees it, finer than any map: on the elevation of the site stand its rocks as boulders,
/// the hidden rocks, pebbles and the odd targets; soil has a texture. All of it follows from the ground and its seed.
class Relief {
 public:
  /// Prepares what lies within `reach` metres of `centre`. The ground has a site, and outlives this.
  Relief(const world::Ground& ground, terrain::Point centre, double reach);

  /// Returns metres, without what stands on the ground.
  double floor(terrain::Point p) const { return ground_.site->elevation(p); }
  /// Returns metres, with what stands there.
  double height(terrain::Point) const;
  /// Returns how high anything stands above floor() at most, in m.
  double tallest() const { return tallest_; }

  /// Says what a spot does with light.
  struct Spot {
    terrain::Gradient slope;
    double albedo = 0;  ///< share of the light that it returns
  };
  /// Describes the ground around a point; what is finer than `footprint` metres is averaged out.
  Spot spot(terrain::Point, double footprint) const;

 private:
  struct Stone {
    terrain::Point at;
    double radius = 0;
    double height = 0;
    double albedo = 0;
    int steps = 0;        // terraces that its flanks have; 0: it is round
    bool smooth = false;  // it has neither edges nor texture
  };

  void add(const Stone&);
  void add_rocks();
  void add_pebbles();
  void add_oddities();
  const std::vector<std::uint32_t>* stones_at(terrain::Point) const;
  double rise(const Stone&, terrain::Point) const;
  double noise(std::uint64_t salt, terrain::Point, double wavelength) const;
  double soil(terrain::Point, double footprint) const;
  double albedo(terrain::Point, double footprint, const Stone* top) const;
  const Stone* top_at(terrain::Point) const;

  const world::Ground& ground_;
  terrain::Point centre_;
  double reach_;
  double tallest_ = 0;
  std::vector<Stone> stones_;
  std::vector<world::Oddity> oddities_;
  int side_;                                      // of the square of bins, each a metre wide
  std::vector<std::vector<std::uint32_t>> bins_;  // indices of the stones that touch them
};

}  // namespace roci::sim::components
