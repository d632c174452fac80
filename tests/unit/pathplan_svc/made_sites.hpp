#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "core/terrain/site.hpp"

namespace roci::pathplan {

// A site of side x side cells, elevation and rock height [m] by functions of position.
inline terrain::Site made_site(int side, double resolution,
                               const std::function<double(terrain::Point)>& elevation,
                               const std::function<double(terrain::Point)>& rock_height) {
  const terrain::Grid grid{side, side, resolution, {0, 0}};
  terrain::SiteLayers layers;
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const terrain::Point p = grid.centre(grid.cell_at(i));
    layers.elevation.push_back(static_cast<float>(elevation(p)));
    layers.rock_height.push_back(static_cast<float>(rock_height(p)));
    layers.occupancy.push_back(terrain::Occupancy::free);
  }
  return {grid, layers};
}

inline double level(terrain::Point) { return 0; }
inline double no_rocks(terrain::Point) { return 0; }

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// Gentle hills, and one rock in about `cells_per_rock` cells.
inline terrain::Site random_site(std::uint64_t seed, int side, unsigned cells_per_rock) {
  std::mt19937_64 random(seed);
  const double a = uniform(random, 0, 6);
  const double b = uniform(random, 0, 6);
  return made_site(
      side, 1.0, [&](terrain::Point p) { return 1.5 * std::sin(p.x / 9 + a) + 1.0 * std::cos(p.y / 7 + b); },
      [&](terrain::Point) {
        return random() % cells_per_rock == 0 ? 0.5 : 0.1 * static_cast<double>(random() % 2);
      });
}

}  // namespace roci::pathplan
