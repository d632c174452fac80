// These limits bound how far the path planner's tables may grow by what comes from the wire (docs/resilience.md,
// "What is bounded").
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "core/temporal/duration.hpp"

namespace roci::pathplan {

/// Hazards that are on the map at one time; one more is refused (event hazard.refused). The map is built anew with each
/// change, which takes time by their number.
inline constexpr std::size_t kHazards = 1'000;
/// Versions of the map in one life of the service; the next life counts on from there, so that no version comes twice.
inline constexpr std::uint64_t kVersionsOfALife = 1'000'000;
/// Merges that wait for a patch; one more is rejected.
inline constexpr std::size_t kMerges = 64;
/// Changes of the map that wait for the worker; hazards beyond it are refused until it has caught up.
inline constexpr std::size_t kMapChanges = 256;
/// Unusable places that are told of once for each map; of those beyond nothing is told.
inline constexpr std::size_t kReportedPlaces = 1'000;
/// Mission time after which answers and search trees that nobody has asked for since may be let go, and after twice of
/// which they are, at the next question: the goals of another day lie elsewhere.
inline constexpr temporal::Duration kUnaskedFor = std::chrono::hours(6);
/// Bytes of a hazard's finder and id.
inline constexpr std::size_t kNameBytes = 1'024;

}  // namespace roci::pathplan
