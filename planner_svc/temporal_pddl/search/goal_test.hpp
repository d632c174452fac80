// Is the plan complete: goals hold, nothing runs (R12), and the timed literals still to come leave the goals
// alone.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class GoalTest {
 public:
  explicit GoalTest(const Task& task);

  bool reached(StateView state, const PlanPrefix& prefix);
  // After a search without success: which goals held in none of the states that were tested.
  std::string explain_failure(std::size_t states) const;

 private:
  const Task& task_;
  Semantics semantics_;
  std::vector<std::vector<bool>> held_;  // by goal alternative and fact
};

}  // namespace roci::planner::temporal_pddl
