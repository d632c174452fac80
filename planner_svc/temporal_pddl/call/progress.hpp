// How far a planning call has come, for whoever watches it.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/temporal/duration.hpp"

namespace roci::planner::temporal_pddl::call {

/// Shows how far a call has come; the call itself keeps it up to date.
struct Progress {
  std::string_view phase = "reading";  ///< what it is doing; of a search of the portfolio, which one
  std::size_t evaluated = 0;           ///< heuristic evaluations so far
  bool has_plan = false;
  double metric = 0;               ///< of the best plan so far, as the problem states it
  temporal::Duration makespan{0};  ///< likewise
};

}  // namespace roci::planner::temporal_pddl::call
