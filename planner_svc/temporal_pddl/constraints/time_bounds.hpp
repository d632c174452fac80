// The absolute times between which each step of a plan must lie. Not stored, but rebuilt for each check
// (R34).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// A timed literal happens exactly at its time; a step in a one-off window within it (R33). A timed literal
// that the plan does not contain yet will follow all its steps (R32): a step that needs or changes what it
// touches must come ε before; one that needs it as an invariant must end no later.
class TimeBounds {
 public:
  TimeBounds(const Task& task, Duration epsilon);

  Ticks earliest(SnapId step) const { return windows_[step].open.count(); }
  // timed_done: how many timed literals the plan contains. kNever: no bound.
  Ticks latest(SnapId step, std::uint32_t timed_done) const;
  // As latest() of a start, for an action that has not ended in the plan: its end must come in its window,
  // and before a timed literal deletes one of its invariants.
  Ticks latest_running(SnapId start, std::uint32_t timed_done) const;

 private:
  const Task& task_;
  Duration epsilon_;
  IdVector<SnapId, TimeWindow> windows_;
  IdVector<VariableId, std::vector<std::uint32_t>>
      timed_;  // the timed steps that touch a variable, ascending
  IdVector<VariableId, std::vector<std::uint32_t>> timed_change_;  // likewise, other than by adding a fact
  IdVector<SnapId, bool>
      touched_;  // some timed step touches a variable of the snap action or of its invariants
};

}  // namespace roci::planner::temporal_pddl
