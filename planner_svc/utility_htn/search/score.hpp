// This file has sums and ratios of utilities by rank.
#pragma once

#include "core/temporal/rank_vector.hpp"

namespace roci::planner::utility_htn::search {

/// Returns the utility rounded to a billionth at each rank, so that equal sums are equal in
/// whatever order they were added.
temporal::RankVector rounded(const temporal::RankVector& utility);
double rounded(double value);

/// Returns utility / cost rank by rank (Z12); for a cost of 0 or less infinity with the sign of the
/// score, 0 for a score of 0.
temporal::RankVector per_cost(const temporal::RankVector& utility, double cost);

/// Returns whether the first score that is not 0 is below 0, with which an Assessor refuses a chain.
bool refused(const temporal::RankVector& utility);

}  // namespace roci::planner::utility_htn::search
