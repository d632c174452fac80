// Searches take a durative action as a start and an end, or compressed into one step (temporal action
// compression, Coles, Fox, Long and Smith 2009).
#pragma once

#include <cstdint>

namespace roci::planner::temporal_pddl::task {

/// Says which actions a search takes as one step.
enum class ActionCompression : std::uint8_t {
  where_safe,  ///< actions that are not compression safe start and end in steps of their own
  /// Every action ends at once; no plan then has actions that run at the same time because they must.
  always,
};

}  // namespace roci::planner::temporal_pddl::task
