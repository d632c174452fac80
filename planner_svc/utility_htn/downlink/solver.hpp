// This file solves the packing problem exactly with CBC (COIN-OR branch and cut), rank by rank: what a higher rank
// has reached becomes a constraint of the lower ones, so that no weights are needed and no gain of a lower rank can
// outweigh one of a higher (Z17).
#pragma once

#include <cstdint>
#include <optional>

#include "planner_svc/utility_htn/downlink/packing.hpp"

namespace roci::planner::utility_htn::downlink {

/// Holds the best placement that was found, and how much of it is proven.
struct Solved {
  Placement placement;
  bool best = false;      ///< proven: utility by rank and the number of items sent
  bool earliest = false;  ///< proven, too
  double gap = 0;         ///< at `rank`, where the search was cut: (bound - value) / bound
  std::uint32_t rank = 0;
};

/// Improves a placement that holds until the best is proven or CBC has taken `most_nodes` nodes for one of the ranks.
/// CBC runs in the caller's thread, prints nothing and asks for no time.
Solved solve(const Packing& packing, const Placement& start, int most_nodes);

/// Returns whether all items can be placed, or nothing when that took more than `most_nodes` nodes.
std::optional<bool> solve_all_fit(const Packing& packing, int most_nodes);

/// Returns the number of pairs of item and bin that CBC would decide.
std::size_t variables(const Packing& packing);

}  // namespace roci::planner::utility_htn::downlink
