#include "planner_svc/temporal_pddl/constraints/time_freedom.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

TimeFreedom::Times& TimeFreedom::touch(VariableId variable) {
  Times& times = times_[variable];
  if (!times.touched) touched_.push_back(variable);
  times.touched = true;
  return times;
}

void TimeFreedom::measure(std::span<const SnapId> steps, std::span<const Ticks> times) {
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

Ticks TimeFreedom::earliest(SnapId step) const {
  Ticks result = 0;
  for (const VariableId variable : task_.reads[step]) result = std::max(result, times_[variable].read);
  for (const VariableId variable : task_.writes[step]) result = std::max(result, times_[variable].change);
  return result;
}

}  // namespace roci::planner::temporal_pddl
