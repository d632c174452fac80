// Is the plan complete: goals hold and nothing runs (R12).
//
// Goals must hold after the last start or end of an action; what timed literals do to them later does not
// count. So if one still to come would undo them, the whole plan must be over before; and if one that has
// happened may have made them true, some action must happen no earlier than it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class GoalTest {
 public:
  GoalTest(const Task& task, TemporalCheck& check, Duration epsilon);

  // If so, the prefix's deadline and closing step are set.
  bool complete(StateView state, PlanPrefix& prefix);
  // May a timed literal undo a goal at all?
  bool has_deadlines() const { return has_deadlines_; }
  // May a timed literal make a goal true? Then how late a finished step may be matters too.
  bool has_openings() const { return has_openings_; }
  // After a search without success: which goals held in none of the states that were tested. cut: some states
  // were not, as they lead nowhere.
  std::string explain_failure(std::size_t states, bool cut) const;

 private:
  void note_held(StateView state);
  // By when all steps must have happened, kNever if there is no such time.
  Ticks deadline(StateView state, std::uint32_t timed_done) const;
  // The time of the last timed literal so far that may have made a goal true.
  Ticks opening(std::uint32_t timed_done) const;
  bool close(PlanPrefix& prefix);

  const Task& task_;
  TemporalCheck& check_;
  Semantics semantics_;
  Duration epsilon_;
  bool has_deadlines_ = false;
  bool has_openings_ = false;
  std::vector<bool> opens_;              // by timed step: it may make a goal true
  std::vector<std::vector<bool>> held_;  // by goal alternative and fact
};

}  // namespace roci::planner::temporal_pddl
