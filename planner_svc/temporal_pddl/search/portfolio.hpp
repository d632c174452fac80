// A portfolio of searches that take turns leads from a task to a first plan.
//
// No way of searching is good for all tasks. So members with names of their own take turns of a fixed number
// of evaluations, some more often: in the manner of sequential portfolios (Helmert, Röger and Karpas 2011)
// and of LAMA's alternation, but resumed instead of restarted.
#pragma once

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/search/resumable_search.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::search {

/// Returns `always` where that makes a difference and the options allow it: every action is one step then,
/// which most tasks allow and which halves the depth.
task::ActionCompression strongest_compression(const task::Task& task, const call::Options& options);

/// Finds a first plan, or proves that there is none. The members are
///  - best-first search with compressed actions, that follows relaxed plans,
///  - the same with starts and ends as steps, which is complete,
///  - best-first width search,
///  - if the goal has alternatives, best-first search for one of them at a time,
///  - best-first search step by step, with compressed actions,
///  - the same with starts and ends as steps, which is complete,
///  - goal serialization.
/// `ff` estimates single goals for the last one. Throws what ResumableSearch::run() throws.
SearchOutcome search_portfolio(const SearchContext& context, const Guide& guide, heuristics::FfHeuristic& ff);

}  // namespace roci::planner::temporal_pddl::search
