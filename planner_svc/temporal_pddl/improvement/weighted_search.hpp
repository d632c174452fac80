// Looks for a plan that is better than a known one: weighted A* on the durations, states evaluated when they
// are generated, everything cut off that is already no better (Richter, Thayer and Ruml 2010, "The joy of
// forgetting").
#pragma once

#include <optional>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/improvement/quality.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// What leads a search: a heuristic and what its estimates count.
struct Guide {
  Heuristic& heuristic;
  CostMeasure measure = CostMeasure::duration;
};

struct WeightedSearchLimits {
  std::int64_t weight = 1;      // of the estimate against what is done so far
  std::size_t evaluations = 0;  // at most
};

struct Better {
  std::optional<PlanPrefix> plan;
  bool exhausted = false;  // without a plan: there is none, but for what limits and cuts may hide
  std::size_t evaluations = 0;
};

// Throws what Watch throws.
Better find_better(const Task& task, const Quality& known, const Guide& guide, const Options& options,
                   const WeightedSearchLimits& limits, Watch& watch, Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
