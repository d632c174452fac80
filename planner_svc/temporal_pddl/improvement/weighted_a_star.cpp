#include "planner_svc/temporal_pddl/improvement/weighted_a_star.hpp"

#include <algorithm>
#include <cmath>

#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/ranked_queue.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::improvement {

using heuristics::CostMeasure, heuristics::Estimate;
using search::Dominance, search::Evaluation, search::GoalTest, search::Guide, search::NodeId,
    search::PlanPrefix, search::RankedQueue, search::Rejection, search::SearchContext, search::StateSpace,
    search::Successor;
using task::ActionCompression, task::ActionId, task::SnapId, task::Task;
using temporal::Duration;

namespace {

class WeightedAStar {
 public:
  WeightedAStar(const SearchContext& context, const PlanQuality& known, const Guide& guide,
                const SearchEffort& effort)
      : context_(context),
        task_(context.task),
        known_(known),
        guide_(guide),
        effort_(effort),
        space_(context.task, context.options.epsilon, ActionCompression::where_safe,
               context.limits.touched()),
        goal_(context.task, space_.check(), context.options.epsilon),
        dominance_(context.task, space_.store(), space_.bounds(), space_.check(), context.options.epsilon,
                   true, true),
        only_grows_(only_grows(context.task)),
        evaluation_(context.task) {}

  BetterPlan run() {
    successor_.state = task_.initial_state;
    if (take_up(NodeId())) return found();
    while (!open_.empty()) {
      const NodeId node = open_.oldest();
      open_.drop_oldest();
      context_.limits.poll();
      ++context_.statistics.expanded;
      space_.restore(node, prefix_);
      for (const SnapId snap : space_.applicable(prefix_)) {
        if (evaluated_ == effort_.evaluations) return {std::nullopt, false, evaluated_};
        ++context_.statistics.generated;
        if (space_.build(prefix_, snap, successor_) != Rejection::none) continue;
        if (guide_.detectors.prove_dead_end(successor_.state, successor_.prefix.running_actions,
                                            space_.steps()))
          continue;
        if (take_up(prefix_.node)) return found();
      }
      context_.limits.memory(space_.store().bytes() + open_.bytes() + dominance_.bytes() + guide_.bytes());
    }
    return {std::nullopt, true, evaluated_};
  }

 private:
  BetterPlan found() { return {std::move(successor_.prefix), false, evaluated_}; }

  // Stores and queues the state in successor_, unless it cannot lead to a better plan. Returns whether it is
  // one.
  bool take_up(NodeId parent) {
    PlanPrefix& prefix = successor_.prefix;
    const PlanQuality quality = quality_of(task_, prefix, space_.check());
    if ((only_grows_ && quality >= known_) || is_too_long(prefix)) return false;
    if (dominance_.dominated(successor_)) return false;
    dominance_.insert(space_.add(parent, successor_), successor_.state, prefix);
    if (goal_.complete(successor_.state, prefix) && quality_of(task_, prefix, space_.check()) < known_)
      return true;

    ++evaluated_;
    ++context_.statistics.evaluated;
    evaluation_.evaluate(successor_, guide_, estimate_);
    if (estimate_.dead_end) return false;
    const std::int64_t total = committed(prefix, quality) + effort_.weight * estimate_.cost;
    open_.push({total, estimate_.steps}, prefix.node);
    return false;
  }

  // Returns what is done so far, counted as the guide counts what is to come: all durations, those of running
  // actions at least; or the metric with those in place of the makespan.
  std::int64_t committed(const PlanPrefix& prefix, const PlanQuality& quality) const {
    Duration busy = quality.busy;
    for (const ActionId action : prefix.running_actions) busy += task_.actions[action].min_duration;
    if (guide_.measure == CostMeasure::duration) return busy.count();
    const auto more = static_cast<double>((busy - quality.makespan).count());
    return quality.metric + std::llround(task_.metric.expression.duration_weight * more);
  }

  SearchContext context_;
  const Task& task_;
  const PlanQuality& known_;
  const Guide& guide_;
  const SearchEffort& effort_;
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

BetterPlan find_better_plan(const SearchContext& context, const PlanQuality& known, const Guide& guide,
                            const SearchEffort& effort) {
  return WeightedAStar(context, known, guide, effort).run();
}

}  // namespace roci::planner::temporal_pddl::improvement
