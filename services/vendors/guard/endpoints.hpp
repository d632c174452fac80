// What participants announce in plain: the endpoints that they have, and for how long they may be silent. A vendor
// keeps each endpoint, some 2 kB, until its participant's lease is over.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace roci::services::vendors::guard {

/// Says that a participant has a writer, a reader or a topic, or has it no longer.
struct EndpointWord {
  std::array<std::uint8_t, 16> guid{};
  std::uint32_t writer = 0;  ///< of discovery, which says it
  std::int64_t number = 0;   ///< of the sample
  bool ended = false;
};
/// Returns what a message that passed (message.hpp) says of endpoints, in its order.
std::vector<EndpointWord> endpoints_in(std::span<const std::uint8_t> message);

/// Bounds the lease that a participant announces, in seconds; of the vendors' own defaults the longest is 20. Whoever
/// is silent for longer is forgotten, however long a vendor is told to wait.
inline constexpr std::uint32_t kLongestLease = 30;
/// Shortens the leases in a message that passed.
void limit_leases(std::span<std::uint8_t> message);

}  // namespace roci::services::vendors::guard
