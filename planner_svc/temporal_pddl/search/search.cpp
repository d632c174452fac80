#include "planner_svc/temporal_pddl/search/search.hpp"

#include <algorithm>
#include <limits>

namespace roci::planner::temporal_pddl {

namespace {

constexpr std::size_t kFirstTurn = 1000;  // evaluations

// Does it make a difference whether actions are taken whole?
bool splits_actions(const Task& task) {
  return std::ranges::any_of(
      task.actions, [](const Action& action) { return !action.instantaneous() && !action.compression_safe; });
}

}  // namespace

SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics) {
  BestFirstSearch complete(task, heuristic, options, ActionSteps::as_needed, watch, statistics);
  if (!options.whole_actions || !splits_actions(task))
    return *complete.run(std::numeric_limits<std::size_t>::max());
  std::optional<BestFirstSearch> whole;
  whole.emplace(task, heuristic, options, ActionSteps::whole, watch, statistics);
  for (std::size_t turn = kFirstTurn;; turn *= 2) {
    if (whole) {
      auto outcome = whole->run(turn, complete.bytes());
      if (outcome && outcome->plan) return std::move(*outcome);
      if (outcome) whole.reset();
    }
    if (auto outcome = complete.run(turn, whole ? whole->bytes() : 0)) return std::move(*outcome);
  }
}

}  // namespace roci::planner::temporal_pddl
