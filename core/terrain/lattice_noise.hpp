/// Random terrain in whole numbers, so that a seed gives the same site on every machine.
#pragma once

#include <cstdint>

namespace roci::terrain {

/// Is SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014): a whole
/// random sequence in integers, equal on every machine.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Returns a number that is uniform in [0, bound) up to a bias below bound / 2^32; bound lies in 1 … 2^31.
  std::int64_t below(std::int64_t bound);

 private:
  std::uint64_t state_;
};

/// Returns value noise on a square lattice, in integers throughout: random values at the lattice points,
/// blended by 3t² − 2t³ between them. `wavelength` is the lattice spacing, `amplitude` the largest absolute
/// value; both, the position and the result are in millimetres.
std::int64_t lattice_noise(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t wavelength,
                           std::int64_t amplitude);

}  // namespace roci::terrain
