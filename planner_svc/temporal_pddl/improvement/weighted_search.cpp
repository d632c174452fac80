#include "planner_svc/temporal_pddl/improvement/weighted_search.hpp"

#include <algorithm>
#include <cmath>

#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/ranked_queue.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl {

namespace {

class WeightedSearch {
 public:
  WeightedSearch(const Task& task, const Quality& known, const Guide& guide, const Options& options,
                 const WeightedSearchLimits& limits, Watch& watch, Statistics& statistics)
      : task_(task),
        known_(known),
        guide_(guide),
        options_(options),
        limits_(limits),
        watch_(watch),
        statistics_(statistics),
        space_(task, options.epsilon, ActionSteps::as_needed),
        goal_(task, space_.check(), options.epsilon),
        dominance_(task, space_.store(), space_.bounds(), space_.check(), options.epsilon, true, true),
        only_grows_(only_grows(task)),
        evaluation_(task) {}

  Better run() {
    successor_.state = task_.initial_state;
    if (take_up(NodeId())) return found();
    while (!open_.empty()) {
      const NodeId node = open_.oldest();
      open_.drop_oldest();
      watch_.poll();
      ++statistics_.expanded;
      space_.restore(node, prefix_);
      for (const SnapId snap : space_.applicable(prefix_)) {
        if (evaluated_ == limits_.evaluations) return {std::nullopt, false, evaluated_};
        ++statistics_.generated;
        if (space_.build(prefix_, snap, successor_) != Rejection::none) continue;
        if (guide_.heuristic.hopeless(successor_.state, successor_.prefix.running_actions, space_.steps()))
          continue;
        if (take_up(prefix_.node)) return found();
      }
      watch_.memory(space_.store().bytes() + open_.bytes() + dominance_.bytes() + guide_.heuristic.bytes());
    }
    return {std::nullopt, true, evaluated_};
  }

 private:
  Better found() { return {std::move(successor_.prefix), false, evaluated_}; }

  // Stores and queues the state in successor_, unless it cannot lead to a better plan. True: it is one.
  bool take_up(NodeId parent) {
    PlanPrefix& prefix = successor_.prefix;
    const Quality quality = quality_of(task_, prefix, space_.check());
    if ((only_grows_ && quality >= known_) || prefix.steps.size() + 2 > kMaxSteps) return false;
    if (dominance_.dominated(successor_)) return false;
    dominance_.insert(space_.add(parent, successor_), successor_.state, prefix);
    if (goal_.complete(successor_.state, prefix) && quality_of(task_, prefix, space_.check()) < known_)
      return true;

    ++evaluated_;
    ++statistics_.evaluated;
    evaluation_.evaluate(successor_, guide_.heuristic, estimate_);
    if (estimate_.dead_end) return false;
    const std::int64_t total = committed(prefix, quality) + limits_.weight * estimate_.cost;
    open_.push({total, estimate_.steps}, prefix.node);
    return false;
  }

  // What is done so far, counted as the guide counts what is to come: all durations, those of running actions
  // at least; or the metric with those in place of the makespan.
  std::int64_t committed(const PlanPrefix& prefix, const Quality& quality) const {
    Ticks busy = quality.busy;
    for (const ActionId action : prefix.running_actions) busy += task_.actions[action].min_duration.count();
    if (guide_.measure == CostMeasure::duration) return busy;
    const auto more = static_cast<double>(busy - quality.makespan);
    return quality.metric + std::llround(task_.metric.expression.duration_weight * more);
  }

  const Task& task_;
  const Quality& known_;
  const Guide& guide_;
  const Options& options_;
  const WeightedSearchLimits& limits_;
  Watch& watch_;
  Statistics& statistics_;
  StateSpace space_;
  GoalTest goal_;
  Dominance dominance_;
  bool only_grows_;
  Evaluation evaluation_;
  RankedQueue<NodeId> open_;

  PlanPrefix prefix_;  // of the node that is expanded
  Successor successor_;
  Estimate estimate_;
  std::size_t evaluated_ = 0;
};

}  // namespace

Better find_better(const Task& task, const Quality& known, const Guide& guide, const Options& options,
                   const WeightedSearchLimits& limits, Watch& watch, Statistics& statistics) {
  return WeightedSearch(task, known, guide, options, limits, watch, statistics).run();
}

}  // namespace roci::planner::temporal_pddl
