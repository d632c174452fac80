#include "planner_svc/temporal_pddl/search/search.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/search/best_first_search.hpp"
#include "planner_svc/temporal_pddl/search/serial_search.hpp"
#include "planner_svc/temporal_pddl/search/width_search.hpp"

namespace roci::planner::temporal_pddl {

namespace {

constexpr std::size_t kTurn = 250;    // evaluations
constexpr std::size_t kOpening = 50;  // before the first turn; easy tasks need no more

// How often turns come. What follows relaxed plans solves most tasks, and of these most with whole actions;
// by novelty is solved what it does not solve.
constexpr std::size_t kFirstShare = 4;
constexpr std::size_t kLookaheadShare = 2;
constexpr std::size_t kWidthShare = 3;
constexpr std::size_t kPlainShare = 1;
constexpr std::size_t kSerialShare = 1;

// Does it make a difference whether actions are taken whole?
bool splits_actions(const Task& task) {
  return std::ranges::any_of(
      task.actions, [](const Action& action) { return !action.instantaneous() && !action.compression_safe; });
}

}  // namespace

ActionSteps simplest_steps(const Task& task, const Options& options) {
  return options.whole_actions && splits_actions(task) ? ActionSteps::whole : ActionSteps::as_needed;
}

namespace {

// One that takes turns; it is set up when its first turn comes.
struct Participant {
  std::size_t share;
  std::function<std::unique_ptr<Searcher>()> make;
  std::unique_ptr<Searcher> searcher = nullptr;
  std::size_t turns = 0;

  double served() const { return static_cast<double>(turns) / static_cast<double>(share); }
};

std::vector<Participant> participants(const Task& task, Heuristic& heuristic, FfHeuristic& ff,
                                      const Options& options, Watch& watch, Statistics& statistics) {
  std::vector<Participant> result;
  const ActionSteps simplest = simplest_steps(task, options);
  const auto best_first = [&](ActionSteps steps, bool lookahead) {
    const std::size_t share = result.empty() ? kFirstShare : lookahead ? kLookaheadShare : kPlainShare;
    const SearchStyle style{steps, lookahead};
    result.push_back({share, [&, style] {
                        return std::make_unique<BestFirstSearch>(task, heuristic, options, style, watch,
                                                                 statistics);
                      }});
  };
  const auto both = [&](bool lookahead) {
    best_first(simplest, lookahead);
    if (simplest != ActionSteps::as_needed) best_first(ActionSteps::as_needed, lookahead);
  };
  if (options.lookahead) both(true);
  if (options.width && options.dominance) {
    result.push_back({kWidthShare, [&, simplest] {
                        return std::make_unique<WidthSearch>(task, heuristic, options, simplest, watch,
                                                             statistics);
                      }});
  }
  both(false);
  if (options.serial) {
    result.push_back({kSerialShare, [&, simplest] {
                        return std::make_unique<SerialSearch>(task, heuristic, ff, options, simplest, watch,
                                                              statistics);
                      }});
  }
  return result;
}

std::size_t bytes(const std::vector<Participant>& participants) {
  std::size_t sum = 0;
  for (const Participant& participant : participants) {
    if (participant.searcher) sum += participant.searcher->bytes();
  }
  return sum;
}

}  // namespace

SearchOutcome search(const Task& task, Heuristic& heuristic, FfHeuristic& ff, const Options& options,
                     Watch& watch, Statistics& statistics) {
  auto all = participants(task, heuristic, ff, options, watch, statistics);
  // None: the search is not over.
  const auto run = [&](std::vector<Participant>::iterator participant, std::size_t evaluations) {
    if (!participant->searcher) participant->searcher = participant->make();
    Searcher& searcher = *participant->searcher;
    auto outcome = searcher.run(evaluations, bytes(all) - searcher.bytes());
    const bool over = outcome && (outcome->plan || searcher.complete());
    if (outcome && !over) all.erase(participant);
    return over ? std::move(outcome) : std::nullopt;
  };
  if (options.serial && all.size() > 1) {
    if (auto outcome = run(all.begin(), kOpening)) return std::move(*outcome);
    ++all.back().turns;
    if (auto outcome = run(all.end() - 1, kTurn)) return std::move(*outcome);
  }
  while (true) {
    const auto next = std::ranges::min_element(all, {}, &Participant::served);
    ++next->turns;
    if (auto outcome = run(next, kTurn)) return std::move(*outcome);
  }
}

}  // namespace roci::planner::temporal_pddl
