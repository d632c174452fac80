// Restarts make other first plans, as variations of one plan lead no further than to the best of its kind.
// Each takes the goals one after the other (GoalSerialization), in another order each time.
#pragma once

#include <cstddef>
#include <optional>

#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Makes one restart after the other. All that it is given must outlive it.
class Restarts {
 public:
  /// Prepares restarts in which the guide prunes and ff estimates single goals.
  Restarts(const search::SearchContext& context, const search::Guide& guide, heuristics::FfHeuristic& ff);

  struct Outcome {
    std::optional<search::PlanPrefix> plan;  ///< the complete plan as it was found
    std::size_t evaluations = 0;             ///< the evaluations that it took, at least 1
  };
  /// Makes the next restart with at most so many evaluations. Throws what SearchLimits throws.
  Outcome next(std::size_t evaluations);
  /// Returns whether there are orders to choose from, and the search came to an end without a plan for few
  /// of them in a row.
  bool promising() const;

 private:
  search::SearchContext context_;
  search::Guide guide_;
  heuristics::FfHeuristic& ff_;
  call::Options options_;  // with another seed each time
  int in_vain_ = 0;
};

}  // namespace roci::planner::temporal_pddl::improvement
