// The surface is how the ground looks to a camera (what lights it, and what on it is unlike the rest; nobody drives
// differently for it), and the soil that no camera sees.
#pragma once
#include <cstdint>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/terrain/grid.hpp"
#include "sim_svc/world/soil.hpp"

namespace roci::sim::world {

/// Holds a direction of unit length in the map frame.
struct Direction {
  double east = 0;
  double north = 0;
  double up = 1;
};

/// Says where the sun stands. Without a day it stands still; with one it goes its way of an equinox day.
struct Sun {
  double azimuth_deg = 200;   ///< from east towards north, while it stands still
  double elevation_deg = 25;  ///< above the horizon, while it stands still
  double day_s = 0;           ///< length of a day; 0: it stands still
  double noon_s = 0;          ///< mission time of a noon
  double latitude_deg = 0;    ///< of the site, north positive
};

/// Returns the direction towards the sun; `up` is below 0 at night.
Direction toward(const Sun&, temporal::Time at);

/// Says what an odd target is: `bright` a patch of light soil, `dark` a smooth dark stone, `layered` an outcrop in
/// bands, `spotted` ground with light spherules.
enum class Look : std::uint8_t { bright, dark, layered, spotted };

/// Describes a target that is unlike the ground around it, in metres. It is low enough to be driven over.
struct Oddity {
  double x = 0;
  double y = 0;
  double radius = 0;
  Look look = Look::bright;
  bool operator==(const Oddity&) const = default;
};

/// Says how the ground looks, and how it bears.
struct Surface {
  Sun sun;
  double odd_per_hectare = 0;  ///< targets that the seed scatters, 0 … 100
  std::vector<Oddity> placed;  ///< targets beside them
  std::uint64_t seed = 1;      ///< of textures and scattered targets; a world sets it to its own
  SoilLayer soil;
};

/// Returns the targets whose centres lie within `reach` metres of a point, the placed ones first: the same for the same
/// surface, whoever asks from where.
std::vector<Oddity> oddities_near(const Surface&, terrain::Point, double reach);

}  // namespace roci::sim::world
