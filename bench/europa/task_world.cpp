#include "bench/europa/task_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bytes/fnv_1a.hpp"
#include "core/pseudorandom/split_mix.hpp"

namespace roci::bench::europa {
namespace {

std::uint64_t mixed(std::uint64_t bits) { return pseudorandom::SplitMix64(bits).next(); }

// Returns a number in (0, 1).
double uniform(const TaskWorld& world, std::string_view task, std::uint32_t execution, std::uint64_t stream) {
  const std::uint64_t key =
      mixed(mixed(mixed(world.seed) ^ bytes::fnv_1a(task)) ^ (std::uint64_t{execution} << 8U | stream));
  return (static_cast<double>(key >> 11U) + 0.5) * 0x1p-53;
}

}  // namespace

Fate fate(const TaskWorld& world, std::string_view task, std::uint32_t execution) {
  // Box and Muller (1958).
  const double radius = std::sqrt(-2 * std::log(uniform(world, task, execution, 0)));
  const double normal = radius * std::cos(2 * std::numbers::pi * uniform(world, task, execution, 1));
  Fate out{.energy = std::max(0.0, 1 + world.bias + world.deviation * normal)};
  const double draw = uniform(world, task, execution, 2);
  const auto& failures = world.failures;
  if (draw >= failures.fail) return out;
  out.failure = draw < failures.flexible                         ? Resolution::flexible
                : draw < failures.flexible + failures.replanning ? Resolution::replanning
                                                                 : Resolution::ground;
  return out;
}

}  // namespace roci::bench::europa
