// The release time of a variable, as schedulers say, is the time from when on a plan leaves it free.
//
// Release times are what Orderings will ask of the steps to come, seen from a schedule of earliest times, and
// so lower bounds for every continuation of the plan.
#pragma once

#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::constraints {

/// Measures the release times of one plan after the other. The task must outlive it.
class ReleaseTimes {
 public:
  explicit ReleaseTimes(const task::Task& task) : task_(task), times_(task.variables()) {}

  /// Takes the steps of a plan with the earliest time of each.
  void measure(std::span<const task::SnapId> steps, std::span<const temporal::Duration> times);

  /// Returns the time before which no step to come may ask for the variable, or change it.
  temporal::Duration to_read(task::VariableId variable) const { return times_[variable].read; }
  temporal::Duration to_change(task::VariableId variable) const { return times_[variable].change; }
  /// Returns the time before which no such step may come.
  temporal::Duration earliest(task::SnapId step) const;

 private:
  struct Times {
    temporal::Duration read{0};    // the last change
    temporal::Duration change{0};  // also the last readers
    bool touched = false;
  };
  Times& touch(task::VariableId variable);

  const task::Task& task_;
  task::IdVector<task::VariableId, Times> times_;
  std::vector<task::VariableId> touched_;
};

}  // namespace roci::planner::temporal_pddl::constraints
