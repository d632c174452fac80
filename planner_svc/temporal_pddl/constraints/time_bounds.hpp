// Until when each step of a plan must have happened, because of timed literals and windows. Not stored, but
// rebuilt for each check (R34).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// A timed literal that the plan does not contain yet will follow all its steps (R32): a step that needs or
// changes what it touches must come ε before; one that needs it as an invariant must end no later. The times
// of the timed literals themselves are their windows.
class TimeBounds {
 public:
  TimeBounds(const Task& task, Duration epsilon);

  // timed_done: how many timed literals the plan contains. kNever: no bound.
  Ticks latest(SnapId step, std::uint32_t timed_done) const;
  // As latest() of a start, for an action that has not ended in the plan: its end must come before a timed
  // literal deletes one of its invariants.
  Ticks latest_running(SnapId start, std::uint32_t timed_done) const;

 private:
  Ticks time_of(std::uint32_t timed_step) const;

  const Task& task_;
  Duration epsilon_;
  IdVector<VariableId, std::vector<std::uint32_t>>
      timed_;  // the timed steps that touch a variable, ascending
  IdVector<VariableId, std::vector<std::uint32_t>> timed_change_;  // likewise, other than by adding a fact
  IdVector<SnapId, bool>
      touched_;  // some timed step touches a variable of the snap action or of its invariants
};

}  // namespace roci::planner::temporal_pddl
