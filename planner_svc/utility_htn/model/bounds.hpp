// These bounds say how large a task network may be (R83), so that it fits into memory together with the chains that
// are made of it. A larger one is refused whole, in binary form before memory is taken for it.
#pragma once

#include <cstddef>

#include "core/temporal/duration.hpp"

namespace roci::planner::utility_htn::model {

inline constexpr std::size_t kMostBytes = 16U << 20U;  ///< of a file, in either form
inline constexpr std::size_t kMostTasks = 20'000;
inline constexpr std::size_t kMostTimelines = 4'096;
inline constexpr std::size_t kMostParameters = 20'000;
inline constexpr std::size_t kMostRanks = 16;
inline constexpr std::size_t kMostBatches = 64;
inline constexpr std::size_t kMostStates = 64;  ///< of one timeline: a constraint holds one bit for each
/// Bounds each list of one task: impacts, constraints, commands, products, decompositions, subtasks.
inline constexpr std::size_t kMostInList = 1'000;
/// Bounds all such lists of all tasks together.
inline constexpr std::size_t kMostItems = 200'000;
inline constexpr std::size_t kLongestText = 1'000;  ///< bytes
inline constexpr std::size_t kDeepestHierarchy = 16;
inline constexpr std::size_t kMostChains = 100'000;  ///< of one requested task
/// Bounds links and conditions of all chains together.
inline constexpr std::size_t kMostLinks = 1'000'000;
inline constexpr temporal::Duration kLongestDuration = temporal::seconds(1e9);  ///< 31 years
inline constexpr double kMostProductBytes = 1e15;

}  // namespace roci::planner::utility_htn::model
