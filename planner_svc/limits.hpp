// These limits bound how far the planner's tables may grow by what comes from the wire. What is beyond is not
// taken in; the event planner.no_room reports it (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::planner {

/// Bound the goals and timelines that an engine which plans all the time hears of: as many as an executive
/// keeps.
inline constexpr std::size_t kGoals = 10'000;
inline constexpr std::size_t kTimelines = 10'000;
/// Bounds the activities of the executed version whose progress is kept: those of the largest plan that the
/// wire carries.
inline constexpr std::size_t kActivities = 100'000;
/// Bounds the numbers that one command brought.
inline constexpr std::size_t kResultValues = 64;
/// Bounds the commands whose results are kept until their activity has left the plan.
inline constexpr std::size_t kResults = 10'000;
/// Bounds the data products that such an engine hears of.
inline constexpr std::size_t kProducts = 2'000;
/// Bounds the offers of functions: a module for each of 256 owners.
inline constexpr std::size_t kOffers = 256;
/// Bound the ground's orders about the network in a run, the bytes of one network, the networks that wait for a
/// cycle, the reasons of a refusal, and the bytes of one.
inline constexpr std::size_t kNetworkOrders = 1'000;
inline constexpr std::size_t kNetworkBytes = 8U << 20U;
inline constexpr std::size_t kNetworksWaiting = 4;
inline constexpr std::size_t kReasons = 50;
inline constexpr std::size_t kReasonBytes = 2'000;
/// Bounds the bytes of a downlink schedule or a mission outlook, well below what their topics carry; they
/// count what had no room.
inline constexpr std::size_t kOutlookBytes = 8U << 20U;
/// Bound what a fact may say: the bytes of one data product, and the amount of an observed number. Each is far beyond
/// any robot, and what engines add up of such values stays exact.
inline constexpr std::uint64_t kProductBytes = 1'000'000'000'000'000;
inline constexpr double kObservedAmount = 1e15;
/// Bounds the decisions of running plans that are open at one time.
inline constexpr std::size_t kDecisions = 1'000;
/// Bounds the bytes of a name that is kept.
inline constexpr std::size_t kNameBytes = 1'024;

}  // namespace roci::planner
