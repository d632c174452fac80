#include "sim_svc/world/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bytes/fnv_1a.hpp"
#include "core/pseudorandom/split_mix.hpp"

namespace roci::sim::world {
namespace {

// Mixes by FNV-1a over the name, started from the seed, and then by the finalizer of SplitMix64, so that near
// seeds lie apart.
std::uint64_t mixed(std::uint64_t seed, std::string_view name) {
  return pseudorandom::finalized(bytes::Fnv1a(seed).add(name).value());
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : origin_(mixed(seed, name)), engine_(origin_) {}

RandomStream RandomStream::branch(std::string_view name) const { return {origin_, name}; }

double RandomStream::uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double RandomStream::factor(double deviation) { return std::max(0.5, 1 + deviation * normal()); }

}  // namespace roci::sim::world
