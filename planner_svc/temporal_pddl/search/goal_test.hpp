// Is the plan complete: goals hold and nothing runs (R12).
//
// Goals must hold after the last step; what timed literals do to them later does not count. So if one still
// to come would undo them, the whole plan must be over before.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class GoalTest {
 public:
  GoalTest(const Task& task, Duration epsilon);

  // None: not complete. Else the time by which all steps must have happened, kNever if there is none.
  std::optional<Ticks> deadline_of_complete(StateView state, const PlanPrefix& prefix);
  // May a timed literal undo a goal at all?
  bool has_deadlines() const { return has_deadlines_; }
  // After a search without success: which goals held in none of the states that were tested.
  std::string explain_failure(std::size_t states) const;

 private:
  const Task& task_;
  Semantics semantics_;
  Duration epsilon_;
  bool has_deadlines_ = false;
  std::vector<std::vector<bool>> held_;  // by goal alternative and fact
};

}  // namespace roci::planner::temporal_pddl
