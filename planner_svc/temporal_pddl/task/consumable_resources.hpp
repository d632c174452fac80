// A consumable resource is a number that plans can only use up, with the amount of it that each may use:
// energy that nothing restores, a tank, a ceiling of cost.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::task {

/// A number of which every snap action takes an amount that depends on its duration at most, and none gives
/// any. Whatever takes is forbidden to leave less than `floor`, by a condition at the same time point or by
/// an invariant up to it.
struct ConsumableResource {
  NumberId number;
  double sign = 1;                 ///< −1 where the number rises and must not rise above −floor
  double floor = 0;                ///< the least allowed value of sign · number
  IdVector<SnapId, double> taken;  ///< is what each snap action takes at least

  /// Returns what is left to be taken in a state.
  double left(const Task& task, StateView state) const {
    return sign * task.layout.numbers(state)[number] - floor;
  }
};

/// Returns all consumable resources of the task.
std::vector<ConsumableResource> find_consumable_resources(const Task& task);

}  // namespace roci::planner::temporal_pddl::task
