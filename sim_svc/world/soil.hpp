// Soil here is loose ground that no map shows and no camera sees: what a wheel finds under it. Only the world knows
// where it lies.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/terrain/grid.hpp"
#include "core/terrain/polygon.hpp"

namespace roci::sim::world {

/// Describes soil by its pressure-sinkage curve p = (k_c / b + k_phi) z^n (Bekker, "Introduction to Terrain-Vehicle
/// Systems", 1969; b is the width of what presses, z the sinkage) and its shear strength c + p tan(phi), of which a
/// shear displacement j brings up the share 1 - exp(-j / K) (Janosi and Hanamoto, 1961).
struct Soil {
  double exponent = 1.1;                ///< n, above 0, at most 2
  double cohesive_modulus = 990;        ///< k_c, N/m^(n+1)
  double frictional_modulus = 1528430;  ///< k_phi, N/m^(n+2), above 0
  double cohesion_pa = 1040;            ///< c
  double friction_deg = 28;             ///< phi, 1 … 60
  double shear_m = 0.025;               ///< K, above 0
  bool operator==(const Soil&) const = default;
};

/// Says where a soil lies, in metres of the map frame: within the outline, or, if it has none, the circle.
struct SoilArea {
  std::string soil;  ///< a key of SoilLayer::soils
  terrain::Point centre;
  double radius = 0;
  terrain::Polygon outline{};
  bool operator==(const SoilArea&) const = default;
};

/// Returns whether the point lies in the area.
bool contains(const SoilArea&, terrain::Point);

/// Lets the run's seed place circles of a soil, anywhere in a box but not over certain discs.
struct ScatteredSoil {
  std::string soil;
  int count = 1;
  double least_radius = 0.5, most_radius = 1.5;  ///< m
  terrain::Point south_west, north_east;         ///< of the box in which the centres lie
  std::vector<SoilArea> clear_of;                ///< circles that no circle touches; their `soil` is empty
};

/// Holds all soil of a world. Where no area lies the ground is firm; of areas that overlap the last one counts.
struct SoilLayer {
  std::map<std::string, Soil> soils;
  std::vector<SoilArea> areas;
  std::vector<ScatteredSoil> scattered;
};

/// Returns the soil at the point, or null where the ground is firm. The areas' soils are all known.
const Soil* soil_at(const SoilLayer&, terrain::Point);

/// Scatters soil into areas, the same for the same layer and seed. A circle that finds no room in a hundred tries
/// is left out.
void scatter(SoilLayer&, std::uint64_t seed);

}  // namespace roci::sim::world
