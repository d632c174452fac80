// Answers most questions of the Downlink Manager without a solver: a greedy placement that meets a bound of the relaxed
// problem is optimal, and a bound that is not enough proves that something does not fit.
#pragma once

#include <cstdint>

#include "planner_svc/utility_htn/downlink/packing.hpp"

namespace roci::planner::utility_htn::downlink {

/// Holds the best greedy placement, and how much of it is proven.
struct Certified {
  Placement placement;  ///< the best of the greedy ones
  bool best = false;    ///< no placement has a higher utility or, with the same, sends more
  bool earliest = false;
  double gap = 0;          ///< at `rank`: (bound - value) / bound
  std::uint32_t rank = 0;  ///< the first that is not proven; the one after all utilities counts what is sent
};

/// Places items greedily in several orders, takes the best, and holds it against bounds: for each rank the fractional
/// knapsack over what windows from some number on can carry together (those constraints are nested, so that taking the
/// densest first is optimal).
Certified certify(const Packing& packing);

/// Says whether all items can be placed, as far as is proven.
enum class AllFit { yes, no, unknown };
/// Tells whether all items can be placed, with proof, or that neither is proven.
AllFit all_fit(const Packing& packing);

/// Returns how many bytes the bins from `first` on (or up to it) can carry at most,
/// by the number of `first`; never too small.
std::vector<double> bytes_from(const Packing& packing);
std::vector<double> bytes_until(const Packing& packing);

/// Returns a lower bound of the sum of the bins' numbers of any placement that sends `sent` items: the first bins
/// together can take no more items than the smallest of those that are there by then.
std::int64_t least_lateness(const Packing& packing, std::int64_t sent);

}  // namespace roci::planner::utility_htn::downlink
