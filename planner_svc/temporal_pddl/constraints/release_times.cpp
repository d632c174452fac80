#include "planner_svc/temporal_pddl/constraints/release_times.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::constraints {

using task::SnapId;
using task::VariableId;
using temporal::Duration;

ReleaseTimes::Times& ReleaseTimes::touch(VariableId variable) {
  Times& times = times_[variable];
  if (!times.touched) touched_.push_back(variable);
  times.touched = true;
  return times;
}

void ReleaseTimes::measure(std::span<const SnapId> steps, std::span<const Duration> times) {
  for (const VariableId variable : touched_) times_[variable] = {};
  touched_.clear();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const VariableId variable : task_.reads[steps[i]]) {
      Times& known = touch(variable);
      known.change = std::max(known.change, times[i]);
    }
    for (const VariableId variable : task_.writes[steps[i]]) {
      Times& known = touch(variable);
      known.read = std::max(known.read, times[i]);
      known.change = std::max(known.change, times[i]);
    }
  }
}

Duration ReleaseTimes::earliest(SnapId step) const {
  Duration result{0};
  for (const VariableId variable : task_.reads[step]) result = std::max(result, times_[variable].read);
  for (const VariableId variable : task_.writes[step]) result = std::max(result, times_[variable].change);
  return result;
}

}  // namespace roci::planner::temporal_pddl::constraints
