#include "science_svc/detector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "science_svc/limits.hpp"

namespace roci::science {
namespace {

constexpr std::uint64_t kScoreSalt = 1;
constexpr std::uint64_t kBearingSalt = 2;
constexpr int kBearings = 8;

// Is the finalizer of SplitMix64 (core/terrain/lattice_noise.hpp names the paper).
std::uint64_t scrambled(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

// Returns a number in [0, 1) from the seed and the square metre.
double draw(std::uint64_t seed, std::uint64_t salt, terrain::Point p) {
  const auto metre = [](double coordinate) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(coordinate)));
  };
  std::uint64_t hash = scrambled(seed + 0x9e3779b97f4a7c15ull * salt);
  hash = scrambled(hash ^ metre(p.x));
  hash = scrambled(hash ^ metre(p.y));
  return static_cast<double>(hash >> 11) * 0x1p-53;
}

}  // namespace

Detector::Detector(DetectorSettings settings, terrain::Grid map, std::uint64_t seed)
    : settings_(std::move(settings)), map_(map), seed_(seed) {}

double Detector::score(terrain::Point taken_from) const { return draw(seed_, kScoreSalt, taken_from); }

bool Detector::full() const { return seen_.size() >= kPhotos; }

std::optional<Find> Detector::look(const Photo& photo, temporal::Time now) {
  if (!settings_.enabled || !map_.contains(photo.taken_from)) return std::nullopt;
  if (full() || photo.id.size() > kNameBytes || !seen_.insert(photo.id).second) return std::nullopt;
  const double value = score(photo.taken_from);
  if (value < settings_.threshold) return std::nullopt;
  if (static_cast<int>(finds_.size()) >= settings_.limit) return std::nullopt;
  if (!finds_.empty() && now - last_find_ < settings_.min_interval) return std::nullopt;
  const auto place = place_near(photo.taken_from);
  if (!place) return std::nullopt;
  const bool known = std::any_of(finds_.begin(), finds_.end(), [&](const Find& find) {
    return terrain::distance(find.place, *place) <= settings_.merge_m;
  });
  if (known) return std::nullopt;
  last_find_ = now;
  finds_.push_back({"find-" + std::to_string(finds_.size() + 1), *place, value});
  return finds_.back();
}

// Returns the place on the map at the first bearing, counted from a drawn one, that leads to one.
std::optional<terrain::Point> Detector::place_near(terrain::Point p) const {
  const double first = draw(seed_, kBearingSalt, p);
  for (int i = 0; i < kBearings; ++i) {
    const double angle = 2 * std::numbers::pi * (first + i / static_cast<double>(kBearings));
    const terrain::Point place{std::round(p.x + settings_.offset_m * std::cos(angle)),
                               std::round(p.y + settings_.offset_m * std::sin(angle))};
    if (map_.contains(place)) return place;
  }
  return std::nullopt;
}

}  // namespace roci::science
