// Earliest times say how early the goals can come about by what is predicted, whatever else is planned: a
// proof, without a search, that one comes too late.
#pragma once

#include <optional>
#include <string>

#include "planner_svc/timeline_htn/search/successors.hpp"

namespace roci::planner::timeline_htn::search {

/// Names a goal that no plan brings about in its window.
struct TooLate {
  Index goal = kNone;
  std::string reason;
};

/// Returns the first goal, in the order of the problem, that cannot begin before its window closes. A timeline that
/// goes there as fast as transitions and shortest durations permit waits where a need or a condition asks for what is
/// predicted; all else is left out, so no plan is faster. `begun` is a plan to which nothing has been added. Without
/// anything predicted it returns nothing.
std::optional<TooLate> too_late(Ground& ground, const Successors& successors, const PartialPlan& begun);

}  // namespace roci::planner::timeline_htn::search
