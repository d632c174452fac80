#include "planner_svc/temporal_pddl/search/best_first_search.hpp"

#include <algorithm>
#include <random>

#include "planner_svc/temporal_pddl/grounding/refusal.hpp"
#include "planner_svc/temporal_pddl/search/blockage.hpp"
#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/open_list.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl {

namespace {

class BestFirstSearch {
 public:
  BestFirstSearch(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                  Statistics& statistics)
      : task_(task),
        heuristic_(heuristic),
        options_(options),
        watch_(watch),
        statistics_(statistics),
        space_(task, options.epsilon),
        goal_(task, space_.check(), options.epsilon),
        dominance_(task, space_.store(), space_.bounds(), space_.check(), options.epsilon,
                   goal_.has_deadlines()),
        dominate_(options.dominance && !goal_.has_openings()),
        evaluation_(task),
        random_(options.seed) {}

  SearchOutcome run() {
    successor_.state = task_.initial_state;
    if (take_up(NodeId())) return found();
    while (const auto entry = open_.pop()) {
      watch_.poll();
      if (prefix_.node != entry->parent) space_.restore(entry->parent, prefix_);
      const Rejection rejection = space_.build(prefix_, entry->snap, successor_);
      if (rejection == Rejection::temporal) ++statistics_.temporally_inconsistent;
      if (rejection != Rejection::none) continue;
      if (heuristic_.hopeless(successor_.state, successor_.prefix.running_actions)) {
        ++statistics_.hopeless;
        continue;
      }
      if (dominate_ && dominance_.dominated(successor_.state, successor_.prefix)) {
        ++statistics_.dominated;
        continue;
      }
      if (take_up(entry->parent)) return found();
    }
    if (too_long_)
      throw Refusal(Verdict::out_of_memory,
                    "a plan may have at most 32767 steps, and none so short was found");
    std::string reason = goal_.explain_failure(space_.store().size());
    const std::string number = blocking_number(task_, space_.store());
    if (!number.empty()) reason += "; " + number;
    return {std::nullopt, {}, std::move(reason)};
  }

 private:
  SearchOutcome found() { return {std::move(successor_.prefix), std::move(successor_.state), {}}; }

  // Stores the state in successor_, evaluates it and queues what can follow. True: it is a goal state.
  bool take_up(NodeId parent) {
    PlanPrefix& prefix = successor_.prefix;
    if (prefix.steps.size() + 2 > kMaxSteps) {
      too_long_ = true;
      return false;
    }
    const NodeId node = space_.add(parent, successor_);
    if (dominate_) dominance_.insert(node, successor_.state, prefix);
    if (goal_.complete(successor_.state, prefix)) return true;

    watch_.poll();
    watch_.evaluations(++statistics_.evaluated);
    evaluation_.evaluate(successor_, heuristic_, estimate_);
    if (!estimate_.dead_end) expand(prefix);
    account();
    return false;
  }

  void expand(const PlanPrefix& prefix) {
    ++statistics_.expanded;
    const Priority priority{estimate_.steps, estimate_.cost};
    if (!best_ || priority < *best_) {
      best_ = priority;
      open_.boost();
    }
    const auto applicable = space_.applicable(prefix);
    candidates_.assign(applicable.begin(), applicable.end());
    if (options_.seed != 0) std::ranges::shuffle(candidates_, random_);
    std::ranges::sort(estimate_.preferred);
    for (const SnapId snap : candidates_) {
      const bool preferred =
          options_.preferred_operators && std::ranges::binary_search(estimate_.preferred, snap);
      open_.push(priority, preferred, {prefix.node, snap});
      ++statistics_.generated;
    }
  }

  void account() {
    statistics_.bytes_per_state = space_.store().mean_bytes_per_state();
    watch_.memory(space_.store().bytes() + open_.bytes() + dominance_.bytes() + heuristic_.bytes());
    if (statistics_.expanded % 1024 == 0) watch_.progress(statistics_);
  }

  const Task& task_;
  Heuristic& heuristic_;
  const Options& options_;
  Watch& watch_;
  Statistics& statistics_;
  StateSpace space_;
  GoalTest goal_;
  Dominance dominance_;
  bool dominate_;
  Evaluation evaluation_;
  OpenList open_;
  std::mt19937_64 random_;

  PlanPrefix prefix_;  // of the entry's parent
  Successor successor_;
  Estimate estimate_;
  std::optional<Priority> best_;
  std::vector<SnapId> candidates_;
  bool too_long_ = false;
};

}  // namespace

SearchOutcome search(const Task& task, Heuristic& heuristic, const Options& options, Watch& watch,
                     Statistics& statistics) {
  return BestFirstSearch(task, heuristic, options, watch, statistics).run();
}

}  // namespace roci::planner::temporal_pddl
