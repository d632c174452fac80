#include "planner_svc/temporal_pddl/search/goal_test.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using task::FactId, task::Goal, task::NumericEffect, task::SnapId, task::SnapKind, task::StateView,
    task::Task, task::Word;
using temporal::Duration, temporal::no_bound;

GoalTest::GoalTest(const Task& task, TemporalCheck& check, Duration epsilon)
    : task_(task),
      check_(check),
      semantics_(task),
      epsilon_(epsilon),
      opens_(task.timed_steps.size(), false) {
  for (std::size_t g = 0; g < task.goals.size(); ++g) {
    const Goal& goal = task.goals[g];
    const auto derived = task.derived_goal_reads[g];
    held_.emplace_back(goal.facts.size(), false);
    const auto wanted = [&](FactId fact) {
      return std::ranges::count(goal.facts, fact) > 0 || std::ranges::count(derived, task.variable(fact)) > 0;
    };
    const auto measured = [&](const NumericEffect& effect) {
      return !goal.comparisons.empty() || std::ranges::count(derived, task.variable(effect.variable)) > 0;
    };
    for (std::size_t i = 0; i < opens_.size(); ++i) {
      const SnapId snap = task.timed_steps[i].snap;
      const bool changes = std::ranges::any_of(task.numeric_effects[snap], measured);
      has_deadlines_ = has_deadlines_ || changes || std::ranges::any_of(task.deletes[snap], wanted);
      opens_[i] = opens_[i] || changes || std::ranges::any_of(task.adds[snap], wanted);
      has_openings_ = has_openings_ || opens_[i];
    }
  }
}

void GoalTest::note_held(StateView state) {
  for (std::size_t goal = 0; goal < task_.goals.size(); ++goal) {
    const auto& facts = task_.goals[goal].facts;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!held_[goal][i] && task_.layout.holds(state, facts[i])) held_[goal][i] = true;
    }
  }
}

Duration GoalTest::deadline(StateView state, std::uint32_t timed_done) const {
  if (!has_deadlines_) return no_bound;
  std::vector<Word> later(state.begin(), state.end());
  for (std::size_t i = timed_done; i < task_.timed_steps.size(); ++i) {
    semantics_.apply(task_.timed_steps[i].snap, 0, later);
    if (!semantics_.goal_satisfied(later)) return task_.timed_steps[i].time - epsilon_;
  }
  return no_bound;
}

Duration GoalTest::opening(std::uint32_t timed_done) const {
  for (std::size_t i = timed_done; i-- > 0;) {
    if (opens_[i]) return task_.timed_steps[i].time;
  }
  return Duration{0};
}

// Any step may be the closing one; later ones are tried first.
bool GoalTest::close(PlanPrefix& prefix) {
  for (std::size_t i = prefix.steps.size(); i-- > 0;) {
    if (task_.snaps[prefix.steps[i]].kind == SnapKind::timed_literal) continue;
    prefix.closing_step = static_cast<std::uint32_t>(i);
    if (check_.earliest(prefix)) return true;
  }
  return false;
}

bool GoalTest::complete(StateView state, PlanPrefix& prefix) {
  note_held(state);
  if (!prefix.running.empty() || !semantics_.goal_satisfied(state)) return false;
  prefix.deadline = deadline(state, prefix.timed_done);
  prefix.closing_time = opening(prefix.timed_done);
  const bool fits = prefix.closing_time == Duration{0} ? check_.earliest(prefix) != nullptr : close(prefix);
  if (fits) return true;
  prefix.deadline = no_bound;
  prefix.closing_time = Duration{0};
  prefix.closing_step = 0;
  return false;
}

std::vector<std::string> GoalTest::never_held() const {
  std::vector<std::string> never;
  for (std::size_t goal = 0; goal < task_.goals.size(); ++goal) {
    const auto& facts = task_.goals[goal].facts;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (!held_[goal][i]) never.push_back(name(task_, facts[i]));
    }
  }
  return never;
}

std::string GoalTest::failure_reason(std::size_t states, bool cut) const {
  std::string never;
  for (const std::string& fact : never_held()) never += " " + fact;
  const std::string tried = "all " + std::to_string(states) +
                            " states that time, numbers and conditions allow were tried" +
                            (cut ? ", but for those that provably lead nowhere; " : "; ");
  const std::string late = has_openings_ ? "; what a timed literal brings about for a goal counts only if an "
                                           "action starts or ends then or later"
                                         : "";
  return tried + (never.empty() ? "each goal can be reached, but not all of them together" + late
                                : "never reached:" + never);
}

}  // namespace roci::planner::temporal_pddl::search
