#include "ground_console/cli/map/layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::console::cli::map {
namespace {

using terrain::Point;

Colour between(Colour a, Colour b, double share) {
  const auto mixed = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

// Returns a factor by which slopes are made steeper, so that the ground of any site shows: that which brings the
// steepest tenth of the cells to about 30 degrees.
double exaggeration(const terrain::Site& site) {
  std::vector<double> slopes;
  const std::size_t stride = std::max<std::size_t>(1, site.grid().cell_count() / 20'000);
  for (std::size_t i = 0; i < site.grid().cell_count(); i += stride) {
    const terrain::Gradient g = site.gradient(site.grid().cell_at(i));
    slopes.push_back(std::hypot(g.east, g.north));
  }
  const auto tenth = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() * 9 / 10);
  std::ranges::nth_element(slopes, tenth);
  return *tenth > 0 ? std::clamp(0.6 / *tenth, 0.2, 8.0) : 1;
}

// Lambert's law with the light from the north-west, 45 degrees high, as on printed maps (Horn, "Hill shading and the
// reflectance map", Proceedings of the IEEE 69(1), 1981).
void draw_shade(const terrain::Site& site, const Scale& scale, Picture& picture) {
  const auto [low, high] = std::ranges::minmax(site.layers().elevation);
  const double span = std::max(1e-6, static_cast<double>(high) - low);
  const double steeper = exaggeration(site);
  const double flat = std::numbers::sqrt2 / 2;
  for_each_pixel(scale.frame(), [&](int x, int y) {
    const Point p = scale.point(x + 0.5, y + 0.5);
    const terrain::Gradient g = site.gradient(p);
    const double east = g.east * steeper, north = g.north * steeper;
    const double lit =
        std::max(0.0, (0.5 * east - 0.5 * north + flat) / std::sqrt(1 + east * east + north * north));
    const Colour ground = between(kLow, kHigh, (site.elevation(p) - low) / span);
    const double shade = lit - flat;
    picture.mix(x, y, ground, 1);
    picture.mix(x, y, shade < 0 ? kShadow : kLight,
                std::min(0.75, std::abs(shade) * (shade < 0 ? 0.95 : 1.6)));
  });
}

// How dark a rock is: its height against half a metre, which no rover of this size passes.
double rock_share(const terrain::Site& site, terrain::Cell c) {
  if (site.occupancy(c) == terrain::Occupancy::occupied) return 1;
  return std::clamp(site.rock_height(c) / 0.5, 0.0, 1.0);
}

void draw_rocks(const terrain::Site& site, const Scale& scale, Picture& picture) {
  for_each_pixel(scale.frame(), [&](int x, int y) {
    const terrain::Cell c = scale.grid().cell_of(scale.point(x + 0.5, y + 0.5));
    if (!scale.grid().contains(c)) return;
    if (site.occupancy(c) == terrain::Occupancy::unknown) {
      picture.mix(x, y, kUnknown, hatched(x, y) ? 0.85 : 0.35);
    } else {
      const double share = rock_share(site, c);
      picture.mix(x, y, kRock, 0.85 * share * share);
    }
  });
}

}  // namespace

double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double lead = length / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

void draw_ground(const terrain::Site& site, const Scale& scale, Picture& picture) {
  draw_shade(site, scale, picture);
  draw_rocks(site, scale, picture);
}

void draw_zones(const MissionMap& map, const Scale& scale, Picture& picture) {
  for (const terrain::Polygon& zone : map.keep_out) {
    for_each_pixel(scale.frame(), [&](int x, int y) {
      if (terrain::contains(zone, scale.point(x + 0.5, y + 0.5)))
        picture.mix(x, y, kKeepOut, hatched(x, y) ? 0.75 : 0.18);
    });
    for (std::size_t i = 0; i < zone.corners.size(); ++i) {
      picture.line(scale.spot(zone.corners[i]), scale.spot(zone.corners[(i + 1) % zone.corners.size()]), 2.5,
                   kKeepOut);
    }
  }
  for (const Circle& zone : map.keep_out_discs) {
    for_each_pixel(scale.frame(), [&](int x, int y) {
      if (terrain::distance(zone.centre, scale.point(x + 0.5, y + 0.5)) <= zone.radius)
        picture.mix(x, y, kKeepOut, hatched(x, y) ? 0.75 : 0.18);
    });
    picture.ring(scale.spot(zone.centre), std::max(3.0, scale.pixels(zone.radius)), 2.5, kKeepOut);
  }
}

}  // namespace roci::console::cli::map
