// This file writes amounts and utilities for roci-network.
#pragma once

#include <string>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::cli {

/// Returns the text with blanks behind it, up to that width.
std::string padded(std::string text, std::size_t width);
/// Returns six digits at most.
std::string number(double value);
/// Returns rank by rank what is not zero: "analysis 0.9, default 0.1".
std::string in_ranks(const temporal::RankVector& utility, const model::Network& network);

}  // namespace roci::planner::utility_htn::cli
