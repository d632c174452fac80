#pragma once
#include <cstdint>
#include <random>
#include <string_view>

namespace roci::sim::world {

/// One source of noise: the same seed and name give the same numbers, whatever the other sources draw. The
/// transforms are our own, since the standard's distributions differ between libraries.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// In [0, 1), 53 bits.
  double uniform();
  /// Standard normal by Box and Muller, "A note on the generation of random normal deviates" (1958).
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace roci::sim::world
