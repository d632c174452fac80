/// How far the executive's tables may grow by what comes from the wire. What is beyond is not taken in: it reaches
/// neither the reactor nor the journal, and an event tells it (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

namespace roci::exec {

/// Goals that are kept, whatever became of them: a goal every five minutes for a month.
inline constexpr std::size_t kGoals = 10'000;
/// Of these, rejected ones: nobody plans for them, and whoever sent them was told why. Beyond it a goal without a fault
/// is still taken.
inline constexpr std::size_t kRejectedGoals = 1'000;
/// Orders of the ground that are kept, and answers to decisions: one each five minutes for a month.
inline constexpr std::size_t kOrders = 10'000;
/// So many orders to make the robot safe find room beyond it.
inline constexpr std::size_t kSafeOrders = 1'000;
inline constexpr std::size_t kAnswers = 10'000;
/// Timelines that are kept of those that the mission's data speak of (components, resources, each goal's product), and
/// as many others.
inline constexpr std::size_t kTimelines = 10'000;
/// Owners of models whose versions are kept: ten services for each of 25 robots.
inline constexpr std::size_t kModelOwners = 256;
/// Bytes of a leader's whole journal that a follower takes in, which keeps them in memory until all have come: a
/// hundred times what a mission of a month leaves (bench/endurance).
inline constexpr std::size_t kJournalCopyBytes = std::size_t{256} << 20;
/// Bytes of a name that is kept: of a timeline, an issuer, an id, an owner.
inline constexpr std::size_t kNameBytes = 1'024;

}  // namespace roci::exec
