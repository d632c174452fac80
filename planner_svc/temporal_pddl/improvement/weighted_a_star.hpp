// Weighted A* on the durations looks for a plan that is better than a known one: states are evaluated when
// they are generated, and everything is cut off that is already no better (Richter, Thayer and Ruml 2010,
// "The joy of forgetting").
#pragma once

#include <optional>

#include "planner_svc/temporal_pddl/improvement/plan_quality.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Bounds a search for a better plan.
struct SearchEffort {
  std::int64_t weight = 1;      ///< the weight of the estimate against what is done so far
  std::size_t evaluations = 0;  ///< bounds how many there are
};

/// Holds what such a search has found.
struct BetterPlan {
  std::optional<search::PlanPrefix> plan;
  bool exhausted = false;  ///< whether there is no better plan, but for what limits and cuts may hide
  std::size_t evaluations = 0;
};

/// Returns a better plan, if one is found within the effort. Throws what SearchLimits throws.
BetterPlan find_better_plan(const search::SearchContext& context, const PlanQuality& known,
                            const search::Guide& guide, const SearchEffort& effort);

}  // namespace roci::planner::temporal_pddl::improvement
