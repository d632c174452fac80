// This file solves the packing problem without saying which bin an item goes into: what can only go into the bins from
// some number on must not be more than those take. With one variable for each item, and one for each bin's bytes, CBC
// proves in some ten milliseconds what it does not begin to prove with one for each pair of item and bin; and what is
// best there bounds every placement.
#pragma once

#include "planner_svc/utility_htn/downlink/packing.hpp"
#include "planner_svc/utility_htn/downlink/solver.hpp"

namespace roci::planner::utility_htn::downlink {

/// Chooses the items that are worth most, rank by rank, as far as the bins together can carry them, places them, and
/// holds the better of that placement and `start` against the bounds. CBC takes at most `most_nodes` nodes for a rank.
/// It never says that the placement is the earliest.
Solved select_and_fill(const Packing& packing, const Placement& start, int most_nodes);

}  // namespace roci::planner::utility_htn::downlink
