// This file reads the small languages inside of a network file: sums for numbers, and comparisons for
// constraints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roci::planner::utility_htn::reading {

/// Holds a sum of products with at most one name in it: constant + factor × name.
struct Expression {
  double constant = 0;
  double factor = 0;
  std::string name{};   ///< empty: a number
  std::string fault{};  ///< what is wrong, with its remedy; empty: nothing
};

/// Reads "12", "-arm_w", "2 * arm_w + 5", "3600 + 4 * 151200". A '-' inside of a name belongs to it,
/// so a difference has spaces round it.
Expression parse_expression(std::string_view text);

/// Takes apart "TIMELINE = WORD", "TIMELINE != WORD", "TIMELINE in WORD, WORD", "TIMELINE >= NUMBER", "TIMELINE <=
/// NUMBER", "TIMELINE = NUMBER" or "TIMELINE in NUMBER .. NUMBER", taken apart.
struct Comparison {
  std::string timeline;
  std::string relation;                 ///< "=", "!=", ">=", "<=", "in"
  std::vector<std::string> operands{};  ///< one, or those of "in"
  bool range = false;                   ///< "in LOWEST .. HIGHEST"
  std::string fault{};
};

Comparison parse_comparison(std::string_view text);

}  // namespace roci::planner::utility_htn::reading
