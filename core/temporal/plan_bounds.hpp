// These bounds say how large plans and conditions may be. A larger one is refused when it is checked, and before
// that when it comes from the wire.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::temporal {

/// Bounds the time points of a plan: those of 300,000 activities with their tokens. Structures made of a plan take
/// memory for every point, used or not.
inline constexpr std::uint32_t kMostPoints = 1'000'000;

/// Bounds the nodes of a condition: a conjunction over 10,000 objects. Describing a tree takes time and memory in its
/// nodes times its depth.
inline constexpr std::size_t kMostConditionNodes = 10'000;

}  // namespace roci::temporal
