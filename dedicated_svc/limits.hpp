// These limits bound how far the tables of a dedicated executive may grow by what comes from the wire
// (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

namespace roci::dedicated {

/// Timelines of which the newest value is known; of those beyond nothing is.
inline constexpr std::size_t kTimelines = 5'000;
/// Answers of calls in one run that its successor would go on with; one that has taken more fails with its process.
inline constexpr std::size_t kTaken = 1'000;
/// Points of a way that a call brings as text; of those beyond it is not brought.
inline constexpr std::size_t kWayPoints = 256;

}  // namespace roci::dedicated
