// Asks a heuristic about a successor: puts together what it may look at.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/constraints/time_freedom.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"

namespace roci::planner::temporal_pddl {

class Evaluation {
 public:
  explicit Evaluation(const Task& task) : absolute_(task.has_absolute_times()), freedom_(task) {}

  void evaluate(const Successor& successor, Heuristic& heuristic, Estimate& estimate) {
    heuristic.evaluate(situation(successor), estimate);
  }
  // Valid until the next call, and as long as the successor stays as it is.
  Situation situation(const Successor& successor) {
    const PlanPrefix& prefix = successor.prefix;
    Situation result{successor.state, prefix.running_actions, prefix.timed_done, nullptr, {}, prefix.steps};
    if (absolute_) {
      freedom_.measure(prefix.steps, successor.times);
      started_.clear();
      for (const Running& running : prefix.running) started_.push_back(successor.times[running.step]);
      result.freedom = &freedom_;
      result.started = started_;
    }
    return result;
  }

 private:
  bool absolute_;  // else times tell a heuristic nothing
  TimeFreedom freedom_;
  std::vector<Ticks> started_;  // by running action
};

}  // namespace roci::planner::temporal_pddl
