// This is the finalizer of MurmurHash3: every bit of the result hangs on every bit of the argument.
#pragma once

#include <cstdint>

namespace roci::planner::temporal_pddl::search {

/// Returns the mixed bits; different arguments have different results.
constexpr std::uint64_t mix(std::uint64_t h) {
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdull;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ull;
  return h ^ h >> 33;
}

}  // namespace roci::planner::temporal_pddl::search
