#include "planner_svc/utility_htn/search/score.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace roci::planner::utility_htn::search {

using temporal::RankVector;

double rounded(double value) {
  constexpr double kParts = 1e9;
  const double whole = std::round(value * kParts);
  return std::abs(whole) < 1e15 ? whole / kParts + 0.0
                                : value;  // beyond that a double has no billionths; −0 is 0
}

RankVector rounded(const RankVector& utility) {
  std::vector<double> scores = utility.scores();
  for (double& score : scores) score = rounded(score);
  return RankVector(std::move(scores));
}

RankVector per_cost(const RankVector& utility, double cost) {
  std::vector<double> scores = utility.scores();
  for (double& score : scores) {
    if (score == 0) continue;
    score = cost > 0 ? score / cost : std::copysign(std::numeric_limits<double>::infinity(), score);
  }
  return RankVector(std::move(scores));
}

bool refused(const RankVector& utility) { return utility < RankVector{}; }

}  // namespace roci::planner::utility_htn::search
