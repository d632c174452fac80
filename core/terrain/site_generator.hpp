// This file makes sites from a seed: hills, craters and rocks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/terrain/pgm.hpp"

namespace roci::terrain {

/// Describes one octave of the hills. All lengths of this file are in millimetres, and positions count from
/// the south-west corner of the site.
struct Octave {
  std::int64_t wavelength;
  std::int64_t amplitude;
};

/// Describes a bowl (parabola) of `depth` below the surroundings with a raised rim of a tenth of it; its
/// walls rise by 4 * depth / diameter at the rim.
struct Crater {
  std::int64_t x;
  std::int64_t y;
  std::int64_t diameter;
  std::int64_t depth;
};

/// Describes a closed ring of rocks of one height.
struct RockRing {
  std::int64_t x;
  std::int64_t y;
  std::int64_t radius;
  std::int64_t rock_height;
};

/// Describes a disc that is kept free of the scattered rocks.
struct Clearing {
  std::int64_t x;
  std::int64_t y;
  std::int64_t radius;
};

/// Says what a site is made of. The defaults are a Mars-like plain of 240 x 240 m with one crater and one
/// ring of rocks that no rover of the slope and clearance of its day can enter or leave.
struct SiteRecipe {
  std::uint64_t seed = 1;
  int cells_per_side = 240;
  std::int64_t resolution = 1000;
  std::vector<Octave> hills = {{96000, 5000}, {48000, 2200}, {24000, 900},
                               {12000, 350},  {6000, 100},   {3000, 30}};
  /// Counts the scattered craters, which have diameters of 8 … 32 m and are 5 … 12 % as deep.
  int crater_count = 14;
  std::vector<Crater> craters = {{190000, 60000, 36000, 9000}};
  std::vector<RockRing> rings = {{50000, 180000, 8000, 700}};
  std::vector<Clearing> clearings = {{40000, 40000, 6000}};
  /// Gives the share of the ground that rocks cover, the k of Golombek and Rapp, "Size-frequency
  /// distributions of rocks on Mars and Earth analog sites", J. Geophys. Res. 102 (1997): rocks of diameter D
  /// [m] or more cover k exp(-q D) with q = 1.79 + 0.152 / k. Diameters of 0.2 … 2 m are drawn; a rock stands
  /// half its diameter high.
  double rock_abundance = 0.05;
};

/// Holds the three files of a site as load_site() reads them.
struct GeneratedSite {
  std::string description;  ///< YAML; names the images rocks.pgm and elevation.pgm
  GreyImage rocks;          ///< 8 bit, black is 1 m high
  GreyImage elevation;      ///< 16 bit
};

/// Makes the files of a site. The same recipe gives the same bytes on every machine: the work goes in
/// integers but for the number of rocks per size class, which is rounded. Throws std::invalid_argument for a
/// recipe without cells, with a non-positive length or an abundance outside [0, 0.4].
GeneratedSite generate_site(const SiteRecipe& recipe);

}  // namespace roci::terrain
