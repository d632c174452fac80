#include "core/pseudorandom/split_mix.hpp"

namespace roci::pseudorandom {

std::uint64_t SplitMix64::next() {
  state_ += 0x9e3779b97f4a7c15U;
  return finalized(state_);
}

std::int64_t SplitMix64::below(std::int64_t bound) {
  return static_cast<std::int64_t>((next() >> 32U) * static_cast<std::uint64_t>(bound) >> 32U);
}

}  // namespace roci::pseudorandom
