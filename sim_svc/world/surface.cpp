#include "sim_svc/world/surface.hpp"

#include <cmath>
#include <numbers>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::sim::world {
namespace {

constexpr double kTile = 10;  // m, side of the square that holds one scattered target at most
constexpr double kTilesPerHectare = 100;
constexpr double kSmallest = 0.5, kLargest = 1.1;  // m, radius of a scattered target
constexpr std::uint64_t kSalt = 0x0dd17a26e75;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

double uniform(pseudorandom::SplitMix64& random) {
  return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

}  // namespace

Direction toward(const Sun& sun, temporal::Time at) {
  if (sun.day_s <= 0) {
    const double azimuth = radians(sun.azimuth_deg), elevation = radians(sun.elevation_deg);
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
  }
  const double hour_angle = 2 * std::numbers::pi * (temporal::to_seconds(at) - sun.noon_s) / sun.day_s;
  const double latitude = radians(sun.latitude_deg);
  return {-std::sin(hour_angle), -std::cos(hour_angle) * std::sin(latitude),
          std::cos(hour_angle) * std::cos(latitude)};
}

std::vector<Oddity> oddities_near(const Surface& surface, terrain::Point p, double reach) {
  std::vector<Oddity> out;
  const auto keep = [&](const Oddity& one) {
    if (terrain::distance({one.x, one.y}, p) <= reach) out.push_back(one);
  };
  for (const Oddity& one : surface.placed) keep(one);
  if (surface.odd_per_hectare <= 0) return out;
  const auto tile = [](double v) { return static_cast<std::int64_t>(std::floor(v / kTile)); };
  for (std::int64_t row = tile(p.y - reach); row <= tile(p.y + reach); ++row) {
    for (std::int64_t column = tile(p.x - reach); column <= tile(p.x + reach); ++column) {
      const std::uint64_t place =
          (static_cast<std::uint64_t>(column) << 32) ^ (static_cast<std::uint64_t>(row) & 0xffffffff);
      pseudorandom::SplitMix64 random(pseudorandom::SplitMix64(surface.seed ^ kSalt).next() ^ place);
      if (uniform(random) * kTilesPerHectare >= surface.odd_per_hectare) continue;
      Oddity one;
      one.x = (static_cast<double>(column) + 0.2 + 0.6 * uniform(random)) * kTile;
      one.y = (static_cast<double>(row) + 0.2 + 0.6 * uniform(random)) * kTile;
      one.radius = kSmallest + (kLargest - kSmallest) * uniform(random);
      one.look = static_cast<Look>(random.below(4));
      keep(one);
    }
  }
  return out;
}

}  // namespace roci::sim::world
