// The bound is what no plan can exceed.
#pragma once

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Returns a utility that no plan for the problem exceeds, rank by rank and so lexicographically: the fractional
/// multiple-choice knapsack of each rank (Dantzig 1957; Sinha and Zoltners 1979), in which the cost of opening a site
/// is paid once by all its samples.
///
/// Proof. Every plan takes at most one chain of each request with costs below the budget, so its score at one rank is
/// that of a feasible choice, which the concave hulls of the requests, filled by slope, can only exceed. Where all
/// chains of a site but its openers wait for a value that only the openers bring about, a plan that holds any of them
/// holds an opener; taking the smallest surcharge of an opener off each opener and charging it once per site lowers no
/// total, so that the hull of the site, begun with that charge, exceeds every choice within it.
///
/// Time and place are not looked at: the bound may lie far above what can be scheduled.
temporal::RankVector utility_bound(const Problem& problem);

}  // namespace roci::planner::utility_htn::search
