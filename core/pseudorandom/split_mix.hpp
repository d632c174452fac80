// Pseudorandom numbers are equal on every machine here, which the distributions of the standard library do
// not promise.
#pragma once

#include <cstdint>

namespace roci::pseudorandom {

/// Mixes all bits of a number so that near ones lie apart: the finalizer of SplitMix64.
/// It is a bijection, and 0 stays 0.
constexpr std::uint64_t finalized(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31U);
}

/// Generates by SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA
/// 2014): a whole random sequence in integers, equal on every machine.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Returns a number that is uniform in [0, bound) up to a bias below bound / 2^32; bound lies in 1 … 2^31.
  std::int64_t below(std::int64_t bound);

 private:
  std::uint64_t state_;
};

}  // namespace roci::pseudorandom
