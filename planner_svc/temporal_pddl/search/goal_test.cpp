#include "planner_svc/temporal_pddl/search/goal_test.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl {

GoalTest::GoalTest(const Task& task, Duration epsilon) : task_(task), semantics_(task), epsilon_(epsilon) {
  for (const Goal& goal : task.goals) {
    held_.emplace_back(goal.facts.size(), false);
    for (const TimedStep& timed : task.timed_steps) {
      const bool deletes = std::ranges::any_of(
          task.deletes[timed.snap], [&](FactId fact) { return std::ranges::count(goal.facts, fact) > 0; });
      const bool changes = !goal.comparisons.empty() && !task.numeric_effects[timed.snap].empty();
      has_deadlines_ = has_deadlines_ || deletes || changes;
    }
  }
}

std::optional<Ticks> GoalTest::deadline_of_complete(StateView state, const PlanPrefix& prefix) {
  for (std::size_t goal = 0; goal < task_.goals.size(); ++goal) {
    const auto& facts = task_.goals[goal].facts;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!held_[goal][i] && task_.layout.holds(state, facts[i])) held_[goal][i] = true;
    }
  }
  if (!prefix.running.empty() || !semantics_.goal_satisfied(state)) return std::nullopt;
  if (!has_deadlines_) return kNever;
  std::vector<Word> later(state.begin(), state.end());
  for (std::size_t i = prefix.timed_done; i < task_.timed_steps.size(); ++i) {
    semantics_.apply(task_.timed_steps[i].snap, 0, later);
    if (!semantics_.goal_satisfied(later)) return (task_.timed_steps[i].time - epsilon_).count();
  }
  return kNever;
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
