#include "planner_svc/utility_htn/search/anytime.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/utility_htn/search/bound.hpp"
#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using temporal::RankVector;

Progress search_anytime(const Problem& problem, const Effort& effort,
                        const std::function<void(const Progress&)>& better) {
  Progress best;
  best.bound = rounded(utility_bound(problem));
  bool first = true;
  std::uint64_t spent = 0;
  for (std::uint64_t entries = std::max<std::uint64_t>(1, effort.first_entries);; entries *= 2) {
    Outcome outcome = search(problem, entries);
    spent += outcome.statistics.entries;
    best.entries = spent;
    const Plan &plan = outcome.plan, &old = best.outcome.plan;
    const bool improved =
        first || plan.utility > old.utility || (plan.utility == old.utility && plan.cost < old.cost);
    const bool done = outcome.complete || spent >= effort.all_entries || (problem.stop && problem.stop());
    if (improved) {
      best.outcome = std::move(outcome);
      best.gap = rounded(best.bound - best.outcome.plan.utility);
    } else {
      best.outcome.complete = outcome.complete;
    }
    if (improved && better) better(best);
    if (done || best.gap == RankVector{}) return best;
    first = false;
  }
}

}  // namespace roci::planner::utility_htn::search
