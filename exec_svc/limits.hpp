// These limits bound how far the executive's tables may grow by what comes from the wire. What is beyond is not
// taken in: it reaches neither the reactor nor the journal, and an event tells of it (docs/resilience.md, "What is
// bounded").
#pragma once

#include <cstddef>

namespace roci::exec {

/// Bounds the goals that are kept, whatever became of them: one every five minutes for a month.
inline constexpr std::size_t kGoals = 10'000;
/// Bounds the rejected goals among them, for which nobody plans and whose senders were told why. Beyond it a goal
/// without a fault is still taken.
inline constexpr std::size_t kRejectedGoals = 1'000;
/// Bounds the orders of the ground that are kept, as kAnswers bounds the answers to decisions: one every five
/// minutes for a month.
inline constexpr std::size_t kOrders = 10'000;
/// Gives room for so many orders to make the robot safe beyond kOrders.
inline constexpr std::size_t kSafeOrders = 1'000;
inline constexpr std::size_t kAnswers = 10'000;
/// Bounds the timelines that are kept of those that the mission's data mention (components, resources, each goal's
/// product), and the others likewise.
inline constexpr std::size_t kTimelines = 10'000;
/// Bounds the owners of models whose versions are kept: ten services for each of 25 robots.
inline constexpr std::size_t kModelOwners = 256;
/// Bounds the bytes of a name that is kept: of a timeline, an issuer, an id, an owner.
inline constexpr std::size_t kNameBytes = 1'024;

}  // namespace roci::exec
