// An oracle of the Downlink Manager that tries every assignment, and the random questions that both answer.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/downlink/manager.hpp"

namespace roci::planner::utility_htn::downlink {

struct RandomQuestion {
  std::vector<Product> products;
  std::vector<Window> windows;
  Limits limits;
};
/// Draws up to 8 products and 4 windows, some with energy limits, and scores that often tie.
RandomQuestion draw(std::mt19937_64& random, bool all_tiers);

/// Tells whether a whole assignment breaks nothing, by the formulas of appendix A.
bool allowed(const RandomQuestion& question, const std::vector<std::optional<std::uint32_t>>& window);

/// Is the worth of an assignment of one tier: sums by rank in steps of kScoreStep, products sent,
/// minus the windows' numbers.
std::vector<std::int64_t> worth_of(const RandomQuestion& question, model::Tier tier,
                                   const std::vector<std::optional<std::uint32_t>>& window);

/// Returns the greatest worth that the tier can have when all other products go as in `window`.
std::vector<std::int64_t> greatest(const RandomQuestion& question, model::Tier tier,
                                   std::vector<std::optional<std::uint32_t>> window);

/// Holds the manager's answer against the oracle; empty, or what is wrong.
std::string fault(const RandomQuestion& question, const Assignment& answer);

}  // namespace roci::planner::utility_htn::downlink
