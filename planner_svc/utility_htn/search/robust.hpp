// Robust plans are judged by what is left of them when tasks need more or less energy than predicted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Says which score of a candidate counts.
enum class Judgement {
  worst,  ///< the least of its scores
  mean,   ///< their mean, rank by rank
};

/// Says under which energy costs candidates are scored, and which score counts.
struct RobustSettings {
  std::vector<double> factors{1.1, 1.0, 0.9};  ///< by which each task's cost is multiplied; above 0
  Judgement judgement = Judgement::worst;
};

/// Holds a plan with its score under each factor.
struct Candidate {
  double made_for = 1;  ///< factor that it was planned for
  Plan plan;
  std::vector<temporal::RankVector> scores{};  ///< in the order of the factors
  temporal::RankVector judged{};
};

/// Holds the chosen plan, and all candidates with their scores.
struct RobustOutcome {
  Outcome outcome;  ///< the chosen one
  std::size_t chosen = 0;
  std::vector<Candidate> candidates{};
  std::string reason;          ///< which candidate was chosen by what, as a sentence
  std::uint64_t explored = 0;  ///< entries of all searches
};

/// Returns what a plan brings when each of its tasks costs `factor` times what is predicted: chains run by start, a
/// chain that would bring the sum to the budget or above ends the mission, and it and what follows count nothing. A
/// chain's worth is what the Assessor predicts after those before it.
temporal::RankVector score_under(const Problem& problem, const Plan& plan, double factor);

/// Returns the score by which a plan is held against others: the worst or the mean of what it brings under the factors.
temporal::RankVector judged(const Problem& problem, const Plan& plan, const RobustSettings& settings);

/// Plans once for each factor with the budget divided by it, scores each plan under all factors, and chooses the one of
/// the best judged score; of equal ones the one whose factor comes first. Throws std::invalid_argument for no factor or
/// one that is not above 0.
RobustOutcome search_robust(const Problem& problem, const RobustSettings& settings, std::uint64_t entries);

}  // namespace roci::planner::utility_htn::search
