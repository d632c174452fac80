#include "planner_svc/temporal_pddl/improvement/weighted_search.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/open_list.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/successor_tree.hpp"

namespace roci::planner::temporal_pddl {

namespace {

class WeightedSearch {
 public:
  WeightedSearch(const Task& task, const Quality& known, Heuristic& heuristic, const Options& options,
                 const WeightedSearchLimits& limits, Watch& watch, Statistics& statistics)
      : task_(task),
        known_(known),
        heuristic_(heuristic),
        options_(options),
        limits_(limits),
        watch_(watch),
        statistics_(statistics),
        store_(task.layout.words()),
        check_(task, options.epsilon),
        builder_(task, store_, check_, options.epsilon),
        goal_(task, check_, options.epsilon),
        dominance_(task, store_, bounds_, check_, options.epsilon, true),
        tree_(task),
        evaluation_(task) {}

  Better run() {
    successor_.state = task_.initial_state;
    if (take_up(NodeId(), Transition{})) return found();
    while (const auto entry = open_.pop()) {
      watch_.poll();
      ++statistics_.expanded;
      rebuild(task_, store_, bounds_, options_.epsilon, entry->parent, prefix_);
      collect_candidates();
      for (const SnapId snap : candidates_) {
        if (!builder_.applicable(prefix_, snap)) continue;
        if (evaluated_ == limits_.evaluations) return {std::nullopt, false, evaluated_};
        ++statistics_.generated;
        if (builder_.build(prefix_, snap, successor_) != Rejection::none) continue;
        if (take_up(prefix_.node, successor_.transition)) return found();
      }
      watch_.memory(store_.bytes() + open_.bytes() + dominance_.bytes());
    }
    return {std::nullopt, true, evaluated_};
  }

 private:
  Better found() { return {std::move(successor_.prefix), false, evaluated_}; }

  void collect_candidates() {
    candidates_.clear();
    for (const ActionId action : prefix_.running_actions) candidates_.push_back(task_.actions[action].end);
    tree_.collect(store_.state(prefix_.node), candidates_);
    if (prefix_.timed_done < task_.timed_steps.size())
      candidates_.push_back(task_.timed_steps[prefix_.timed_done].snap);
  }

  // Stores and queues the state in successor_, unless it cannot lead to a better plan. True: it is one.
  bool take_up(NodeId parent, Transition transition) {
    PlanPrefix& prefix = successor_.prefix;
    const Quality quality = quality_of(task_, prefix, check_);
    if (quality >= known_ || prefix.steps.size() + 2 > kMaxSteps) return false;
    if (dominance_.dominated(successor_.state, prefix)) return false;
    code_.clear();
    const auto fresh = std::span(prefix.constraints).last(successor_.new_constraints);
    for (const StepConstraint& constraint : fresh) encode(constraint, options_.epsilon, bounds_, code_);
    prefix.node = store_.add(successor_.state, parent, transition, code_);
    dominance_.insert(prefix.node, successor_.state, prefix);
    if (goal_.complete(successor_.state, prefix) && quality_of(task_, prefix, check_) < known_) return true;

    ++evaluated_;
    ++statistics_.evaluated;
    evaluation_.evaluate(successor_, heuristic_, estimate_);
    if (estimate_.dead_end) return false;
    const std::int64_t total = committed(prefix, quality.busy) + limits_.weight * estimate_.cost;
    open_.push({total, estimate_.steps}, false, {prefix.node, SnapId()});
    return false;
  }

  // What is done so far: all durations, those of running actions at least.
  Ticks committed(const PlanPrefix& prefix, Ticks busy) const {
    for (const ActionId action : prefix.running_actions) busy += task_.actions[action].min_duration.count();
    return busy;
  }

  const Task& task_;
  const Quality& known_;
  Heuristic& heuristic_;
  const Options& options_;
  const WeightedSearchLimits& limits_;
  Watch& watch_;
  Statistics& statistics_;
  StateStore store_;
  BoundTable bounds_;
  TemporalCheck check_;
  SuccessorBuilder builder_;
  GoalTest goal_;
  Dominance dominance_;
  SuccessorTree tree_;
  Evaluation evaluation_;
  OpenList open_;

  PlanPrefix prefix_;  // of the node that is expanded
  Successor successor_;
  Estimate estimate_;
  std::vector<SnapId> candidates_;
  std::vector<std::uint8_t> code_;
  std::size_t evaluated_ = 0;
};

}  // namespace

Better find_better(const Task& task, const Quality& known, Heuristic& heuristic, const Options& options,
                   const WeightedSearchLimits& limits, Watch& watch, Statistics& statistics) {
  return WeightedSearch(task, known, heuristic, options, limits, watch, statistics).run();
}

}  // namespace roci::planner::temporal_pddl
