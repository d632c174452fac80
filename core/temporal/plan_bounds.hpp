// How large plans and conditions may be. What is larger is refused when it is checked, and before that when it comes
// from the wire.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::temporal {

/// A plan has at most so many time points: those of 300,000 activities with their tokens. What is made of a plan takes
/// memory for every point, used or not.
inline constexpr std::uint32_t kMostPoints = 1'000'000;

/// A condition has at most so many nodes: a conjunction over 10,000 objects. Words for a tree take time and memory by
/// its nodes times its depth.
inline constexpr std::size_t kMostConditionNodes = 10'000;

}  // namespace roci::temporal
