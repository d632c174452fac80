// Greedy best-first search with deferred evaluation: a state is evaluated when it is taken up, its successors
// wait with its estimate (Helmert 2006, section 6).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

struct SearchOutcome {
  std::optional<PlanPrefix> plan;  // none: there is no plan
  std::vector<Word> final_state;   // with a plan
  std::string reason;              // without: what stood in the way
};

// Keeps `statistics` up to date all the time. Throws what Watch throws, and Refusal (out_of_memory) if plans
// of more than kMaxSteps steps would have to be tried.
SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics);

}  // namespace roci::planner::temporal_pddl
