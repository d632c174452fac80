// Numbers that plans can only use up, and how much of each they may: energy that nothing restores, a tank, a
// ceiling of cost.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// Every snap action takes an amount that depends on its duration at most, none gives, and whatever takes is
// forbidden to leave less than `floor`: by a condition at the same time point, or by an invariant up to it.
struct Resource {
  NumberId number;
  double sign = 1;                 // −1: rises, and must not rise above −floor
  double floor = 0;                // of sign · value
  IdVector<SnapId, double> taken;  // at least, by snap action

  // What is left to be taken in a state.
  double left(const Task& task, StateView state) const {
    return sign * task.layout.numbers(state)[number] - floor;
  }
};

std::vector<Resource> find_resources(const Task& task);

}  // namespace roci::planner::temporal_pddl
