// A linear program in which some variables are 0 or 1, which CBC (COIN-OR branch and cut) solves.
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace roci::planner::utility_htn::downlink {

/// Describes a variable: 0 or 1, or any number from 0 to `upper`.
struct Variable {
  double gain = 0;  ///< a whole number
  bool whole = true;
  double upper = 1;
};

/// Bounds a weighted sum of variables: lower <= sum <= upper.
struct Row {
  std::vector<std::pair<int, double>> terms{};  ///< variable and its weight
  double lower = -std::numeric_limits<double>::max();
  double upper = std::numeric_limits<double>::max();
};

/// Holds what CBC found.
struct Optimum {
  std::vector<double> values{};  ///< by variable; empty: nothing above what was asked for was found
  bool ended = false;            ///< the search came to its end: this is best, or nothing better is there
  double bound = 0;              ///< of the gain, when it did not end
};

/// Looks for the values of greatest gain among those of more than `above`, in at most `most_nodes` nodes; 0 and 1 are
/// told as such. Rows may be broken by as much as a tolerance of 1e-7. CBC runs in the caller's thread, prints nothing
/// and asks for no time.
Optimum maximize(const std::vector<Variable>& variables, const std::vector<Row>& rows, double above,
                 int most_nodes);

}  // namespace roci::planner::utility_htn::downlink
