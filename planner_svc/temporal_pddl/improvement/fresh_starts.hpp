// Other first plans, as variations of one plan lead no further than to the best of its kind: the goals one
// after the other (SerialSearch), in another order each time.
#pragma once

#include <cstddef>
#include <optional>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

class FreshStarts {
 public:
  // pruning: is asked what is hopeless.
  FreshStarts(const Task& task, Heuristic& pruning, FfHeuristic& ff, const Options& options, Watch& watch,
              Statistics& statistics);

  struct Outcome {
    std::optional<PlanPrefix> plan;  // complete, as it was found
    std::size_t evaluations = 0;     // the work that it was, at least 1
  };
  // With at most so many evaluations. Throws what Watch throws.
  Outcome next(std::size_t evaluations);
  // There are orders to choose from, and the search came to an end without a plan for few of them in a row.
  bool promising() const;

 private:
  const Task& task_;
  Heuristic& pruning_;
  FfHeuristic& ff_;
  Options options_;  // with another seed each time
  Watch& watch_;
  Statistics& statistics_;
  int in_vain_ = 0;
};

}  // namespace roci::planner::temporal_pddl
