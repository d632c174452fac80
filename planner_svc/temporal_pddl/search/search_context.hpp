// The search context holds what the search loops of a planning call share.
#pragma once

#include <cstddef>

#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/call/statistics.hpp"
#include "planner_svc/temporal_pddl/dead_ends/dead_end_detector.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Holds the task and the terms of the call. All of it must outlive the searches; these keep the statistics
/// up to date all the time and report to the limits.
struct SearchContext {
  const task::Task& task;
  const call::Options& options;
  call::SearchLimits& limits;
  call::Statistics& statistics;
};

/// Holds what leads a search: a heuristic with what its estimates count, and the detectors of dead ends that
/// prune for it.
struct Guide {
  heuristics::Heuristic& heuristic;
  dead_ends::DeadEndDetectors& detectors;
  heuristics::CostMeasure measure = heuristics::CostMeasure::duration;

  std::size_t bytes() const { return heuristic.bytes() + detectors.bytes(); }
};

}  // namespace roci::planner::temporal_pddl::search
