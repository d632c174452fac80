// This file packs a chosen set of items with next to no waste, where first fit leaves a gap in each bin.
#pragma once

#include <vector>

#include "planner_svc/utility_htn/downlink/packing.hpp"

namespace roci::planner::utility_htn::downlink {

/// Names items, and how many bytes each bin would take of them if they could be divided.
struct Chosen {
  std::vector<bool> items;
  std::vector<double> bytes;  ///< by bin, beside what it has used
};

/// Fills the bins from the first one to the last with the chosen items, in several orders, of which the best placement
/// is returned. Each bin is closed with those items that come nearest to the bytes that it is to take. What finds no
/// room so takes that of items that are worth less, by rank; what is not chosen gets what is left. The placement holds.
Placement fill(const Packing& packing, const Chosen& chosen);

}  // namespace roci::planner::utility_htn::downlink
