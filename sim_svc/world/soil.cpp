#include "sim_svc/world/soil.hpp"

#include <algorithm>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::sim::world {
namespace {

constexpr std::uint64_t kSoilSalt = 0x5011de9;
constexpr int kTries = 100;

double uniform(pseudorandom::SplitMix64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random.next() >> 11) * 0x1p-53;
}

bool touches(const SoilArea& disc, const SoilArea& other) {
  return terrain::distance(disc.centre, other.centre) < disc.radius + other.radius;
}

}  // namespace

bool contains(const SoilArea& area, terrain::Point p) {
  if (!area.outline.corners.empty()) return terrain::contains(area.outline, p);
  return terrain::distance(area.centre, p) <= area.radius;
}

const Soil* soil_at(const SoilLayer& layer, terrain::Point p) {
  const auto area = std::find_if(layer.areas.rbegin(), layer.areas.rend(),
                                 [&](const SoilArea& one) { return contains(one, p); });
  return area == layer.areas.rend() ? nullptr : &layer.soils.at(area->soil);
}

void scatter(SoilLayer& layer, std::uint64_t seed) {
  pseudorandom::SplitMix64 random(pseudorandom::SplitMix64(seed ^ kSoilSalt).next());
  for (const ScatteredSoil& some : layer.scattered) {
    for (int i = 0; i < some.count; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        SoilArea area{some.soil, {}, 0, {}};
        area.centre.x = uniform(random, some.south_west.x, some.north_east.x);
        area.centre.y = uniform(random, some.south_west.y, some.north_east.y);
        area.radius = uniform(random, some.least_radius, some.most_radius);
        if (std::ranges::any_of(some.clear_of, [&](const SoilArea& disc) { return touches(disc, area); }))
          continue;
        layer.areas.push_back(std::move(area));
        break;
      }
    }
  }
  layer.scattered.clear();
}

}  // namespace roci::sim::world
