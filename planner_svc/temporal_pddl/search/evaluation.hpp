// This class asks a guide about a successor: it puts together what a heuristic may look at.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/constraints/release_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"

namespace roci::planner::temporal_pddl::search {

/// Asks a guide about one successor after the other and keeps its memory in between.
class Evaluation {
 public:
  explicit Evaluation(const task::Task& task) : absolute_(task.has_absolute_times()), release_times_(task) {}

  void evaluate(const Successor& successor, const Guide& guide, heuristics::Estimate& estimate) {
    guide.detectors.note_evaluation();
    guide.heuristic.evaluate(context_of(successor), estimate);
  }
  /// Returns what a heuristic may look at; it is valid until the next call, and as long as the successor
  /// stays as it is.
  heuristics::EvaluationContext context_of(const Successor& successor) {
    const PlanPrefix& prefix = successor.prefix;
    heuristics::EvaluationContext result{
        successor.state, prefix.running_actions, prefix.timed_done, nullptr, {}, prefix.steps};
    if (absolute_) {
      release_times_.measure(prefix.steps, successor.times);
      started_.clear();
      for (const Running& running : prefix.running) started_.push_back(successor.times[running.step]);
      result.release_times = &release_times_;
      result.started = started_;
    }
    return result;
  }

 private:
  bool absolute_;  // else times tell a heuristic nothing
  constraints::ReleaseTimes release_times_;
  std::vector<temporal::Duration> started_;  // by running action
};

}  // namespace roci::planner::temporal_pddl::search
