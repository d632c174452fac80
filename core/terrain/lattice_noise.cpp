#include "core/terrain/lattice_noise.hpp"

#include "core/pseudorandom/split_mix.hpp"

namespace roci::terrain {

using pseudorandom::finalized;

namespace {

constexpr std::int64_t kOne = 1 << 16;  // fixed point: 16 bits behind the point

// Returns the value at a lattice point, from -kOne to kOne.
std::int64_t value_at(std::uint64_t seed, std::int64_t column, std::int64_t row) {
  const std::uint64_t place =
      (static_cast<std::uint64_t>(column) << 32) ^ (static_cast<std::uint64_t>(row) & 0xffffffff);
  const std::uint64_t hash = finalized(finalized(seed) ^ finalized(place + 0x9e3779b97f4a7c15ULL));
  return static_cast<std::int64_t>(hash >> 47) - kOne;
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

std::int64_t smooth_step(std::int64_t t) { return t * t / kOne * (3 * kOne - 2 * t) / kOne; }

std::int64_t blend(std::int64_t a, std::int64_t b, std::int64_t weight) {
  return a + (b - a) * weight / kOne;
}

}  // namespace

std::int64_t lattice_noise(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t wavelength,
                           std::int64_t amplitude) {
  const std::int64_t column = floor_divide(x, wavelength);
  const std::int64_t row = floor_divide(y, wavelength);
  const std::int64_t east = smooth_step((x - column * wavelength) * kOne / wavelength);
  const std::int64_t north = smooth_step((y - row * wavelength) * kOne / wavelength);
  const std::int64_t low = blend(value_at(seed, column, row), value_at(seed, column + 1, row), east);
  const std::int64_t high = blend(value_at(seed, column, row + 1), value_at(seed, column + 1, row + 1), east);
  return blend(low, high, north) * amplitude / kOne;
}

}  // namespace roci::terrain
