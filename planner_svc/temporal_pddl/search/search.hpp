// From a task to a first plan.
#pragma once

#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

namespace roci::planner::temporal_pddl {

// Two searches take turns, each for twice as long as the time before: one in which every action is a step of
// its own, which most tasks allow and which halves the depth; and the complete one. Throws what
// BestFirstSearch throws.
SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
