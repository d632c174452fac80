// From when on a plan leaves each variable free: what Orderings will ask of the steps to come, seen from a
// schedule of earliest times. Lower bounds for every continuation of the plan.
#pragma once

#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class TimeFreedom {
 public:
  explicit TimeFreedom(const Task& task) : task_(task), times_(task.variables()) {}

  // steps: of a plan, with the earliest time of each.
  void measure(std::span<const SnapId> steps, std::span<const Ticks> times);

  // No step to come that asks for the variable, or changes it, may be earlier.
  Ticks to_read(VariableId variable) const { return times_[variable].read; }
  Ticks to_change(VariableId variable) const { return times_[variable].change; }
  // By snap action: no such step to come may be earlier.
  Ticks earliest(SnapId step) const;

 private:
  struct Times {
    Ticks read = 0;    // the last change
    Ticks change = 0;  // also the last readers
    bool touched = false;
  };
  Times& touch(VariableId variable);

  const Task& task_;
  IdVector<VariableId, Times> times_;
  std::vector<VariableId> touched_;
};

}  // namespace roci::planner::temporal_pddl
