#include "planner_svc/temporal_pddl/search/goal_test.hpp"

namespace roci::planner::temporal_pddl {

GoalTest::GoalTest(const Task& task) : task_(task), semantics_(task) {
  for (const Goal& goal : task.goals) held_.emplace_back(goal.facts.size(), false);
}

bool GoalTest::reached(StateView state, const PlanPrefix& prefix) {
  for (std::size_t goal = 0; goal < task_.goals.size(); ++goal) {
    const auto& facts = task_.goals[goal].facts;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!held_[goal][i] && task_.layout.holds(state, facts[i])) held_[goal][i] = true;
    }
  }
  if (!prefix.running.empty() || !semantics_.goal_satisfied(state)) return false;
  if (prefix.timed_done == task_.timed_steps.size()) return true;
  std::vector<Word> last(state.begin(), state.end());
  for (std::size_t i = prefix.timed_done; i < task_.timed_steps.size(); ++i) {
    semantics_.apply(task_.timed_steps[i].snap, 0, last);
  }
  return semantics_.goal_satisfied(last);
}

std::string GoalTest::explain_failure(std::size_t states) const {
  std::string never;
  for (std::size_t goal = 0; goal < task_.goals.size(); ++goal) {
    const auto& facts = task_.goals[goal].facts;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!held_[goal][i]) never += " " + name(task_, facts[i]);
    }
  }
  const std::string tried =
      "all " + std::to_string(states) + " states that time, numbers and conditions allow were tried; ";
  return tried + (never.empty() ? "each goal can be reached, but not all of them together"
                                : "never reached:" + never);
}

}  // namespace roci::planner::temporal_pddl
