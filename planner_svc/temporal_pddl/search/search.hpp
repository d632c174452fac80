// From a task to a first plan.
#pragma once

#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

namespace roci::planner::temporal_pddl {

// Several searches take turns, each for twice as long as the time before, as no way of searching is good for
// all tasks: with every action as a step of its own, which most tasks allow and which halves the depth, or
// with starts and ends; with relaxed plans followed, or step by step. Throws what BestFirstSearch throws.
SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
