// This file counts the chains of a network's parents without making them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {

/// Says what becomes of one task when the hierarchy is flattened. Numbers stop at SIZE_MAX.
struct Extent {
  std::size_t depth = 0;   ///< levels of parents, 0 of a primitive task
  std::size_t chains = 1;  ///< ways to do it
  std::size_t links = 1;   ///< primitive tasks and conditions in all of them together
};

/// Holds the extents of all tasks, or a cycle of parents.
struct Hierarchy {
  std::vector<Extent> extents{};   ///< by TaskIndex; empty where there is a cycle
  std::vector<TaskIndex> cycle{};  ///< each the parent of the next, the last of the first; empty: none
};

/// Measures the hierarchy in time and memory by its edges. Indices of subtasks are in range.
Hierarchy measure(const Network& network);

}  // namespace roci::planner::utility_htn::model
