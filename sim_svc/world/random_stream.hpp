// Noise is the same for the same seed, whatever else is drawn.
#pragma once
#include <cstdint>
#include <random>
#include <string_view>

namespace roci::sim::world {

/// Draws from one source of noise: the same seed and name give the same numbers, whatever the other sources
/// draw. The transforms are our own, since the standard's distributions differ between libraries.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// Returns a stream of its own for a part of what this one serves: it depends on the name and on where this one
  /// began, not on what was drawn, and drawing from it moves nothing here.
  RandomStream branch(std::string_view name) const;

  /// Returns a number in [0, 1) with 53 bits.
  double uniform();
  /// Returns a standard normal number by Box and Muller, "A note on the generation of random normal deviates"
  /// (1958).
  double normal();
  /// Returns a normal number around 1 with that standard deviation, no less than a half: what noise makes of a duration
  /// or a power.
  double factor(double deviation);

 private:
  std::uint64_t origin_;
  std::mt19937_64 engine_;
};

}  // namespace roci::sim::world
