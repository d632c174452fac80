#include "bench/europa/fates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roci::bench::europa {

using rehearsal::task_level::Failure, rehearsal::task_level::Fate;

namespace {

// SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

}  // namespace

double draw(std::uint64_t seed, const std::string& what, std::uint32_t which) {
  std::uint64_t state = mix(seed);
  for (const char one : what) state = mix(state ^ static_cast<unsigned char>(one));
  return static_cast<double>(mix(state ^ which) >> 11U) * 0x1.0p-53;
}

Fate fate(const Odds& odds, std::uint64_t seed, const std::string& task, std::uint32_t execution) {
  Fate out;
  const double radius = std::sqrt(-2 * std::log(1 - draw(seed, task + "/radius", execution)));
  const double normal = radius * std::cos(2 * std::numbers::pi * draw(seed, task + "/angle", execution));
  out.energy = std::max(0.2, 1 + odds.bias + odds.noise * normal);
  if (draw(seed, task + "/fails", execution) >= odds.fail) return out;
  const double how = draw(seed, task + "/how", execution);
  const double replanned = odds.flexible_share + (1 - odds.flexible_share) * odds.replanning_share_of_rest;
  out.failure = how < odds.flexible_share ? Failure::flexible
                : how < replanned         ? Failure::replanning
                                          : Failure::ground;
  return out;
}

}  // namespace roci::bench::europa
