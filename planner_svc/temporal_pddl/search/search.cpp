#include "planner_svc/temporal_pddl/search/search.hpp"

#include <algorithm>
#include <list>
#include <vector>

namespace roci::planner::temporal_pddl {

namespace {

constexpr std::size_t kFirstTurn = 250;  // evaluations

// Does it make a difference whether actions are taken whole?
bool splits_actions(const Task& task) {
  return std::ranges::any_of(
      task.actions, [](const Action& action) { return !action.instantaneous() && !action.compression_safe; });
}

std::vector<SearchStyle> styles(const Task& task, const Options& options) {
  std::vector<SearchStyle> result;
  for (const bool lookahead : {true, false}) {
    if (lookahead && !options.lookahead) continue;
    if (options.whole_actions && splits_actions(task)) result.push_back({ActionSteps::whole, lookahead});
    result.push_back({ActionSteps::as_needed, lookahead});
  }
  return result;
}

std::size_t bytes(const std::list<BestFirstSearch>& searches) {
  std::size_t sum = 0;
  for (const BestFirstSearch& search : searches) sum += search.bytes();
  return sum;
}

}  // namespace

SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics) {
  std::list<BestFirstSearch> searches;
  for (const SearchStyle style : styles(task, options))
    searches.emplace_back(task, heuristic, options, style, watch, statistics);
  for (std::size_t turn = kFirstTurn;; turn *= 2) {
    for (auto search = searches.begin(); search != searches.end();) {
      auto outcome = search->run(turn, bytes(searches) - search->bytes());
      if (outcome && (outcome->plan || search->complete())) return std::move(*outcome);
      search = outcome ? searches.erase(search) : std::next(search);
    }
  }
}

}  // namespace roci::planner::temporal_pddl
