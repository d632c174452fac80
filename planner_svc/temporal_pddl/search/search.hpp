// From a task to a first plan.
#pragma once

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/searcher.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// Whole actions where that makes a difference.
ActionSteps simplest_steps(const Task& task, const Options& options);

// Several searches take turns, some more often, as no way of searching is good for all tasks: with every
// action as a step of its own, which most tasks allow and which halves the depth, or with starts and ends; by
// estimates, with relaxed plans followed or step by step; goal by goal (SerialSearch); or by novelty
// (WidthSearch). Throws what Searcher::run() throws.
SearchOutcome search(const Task& task, Heuristic& heuristic, FfHeuristic& ff, const Options& options,
                     Watch& watch, Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
