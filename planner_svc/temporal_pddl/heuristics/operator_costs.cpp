#include "planner_svc/temporal_pddl/heuristics/operator_costs.hpp"

#include <algorithm>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using task::Action, task::FactId, task::Goal, task::IdVector, task::SnapId, task::StateView, task::Task;

namespace {

std::vector<FactId> goals_of_all_alternatives(const Task& task) {
  std::vector<FactId> result;
  if (task.goals.empty()) return result;
  std::ranges::copy_if(task.goals.front().facts, std::back_inserter(result), [&](FactId fact) {
    return std::ranges::all_of(task.goals,
                               [&](const Goal& goal) { return std::ranges::count(goal.facts, fact) > 0; });
  });
  return result;
}

}  // namespace

OperatorCosts::OperatorCosts(const Task& task, const RelaxedTask& relaxed)
    : task_(task), relaxed_(relaxed), goals_(goals_of_all_alternatives(task)), costs_(relaxed.operators()) {
  for (std::size_t i = 0; i < relaxed.operators(); ++i)
    costs_[SnapId(i)] = relaxed.is_choice(SnapId(i)) ? 1 : 0;
  IdVector<FactId, bool> is_goal(task.fact_names.size(), false);
  for (const FactId fact : goals_) is_goal[fact] = true;
  std::vector<std::vector<SnapId>> undone_by(goals_.size());
  for (const Action& action : task.actions) {
    const auto note = [&](FactId fact) {
      if (!is_goal[fact] || !undoes(task, action, fact)) return;
      auto& list = undone_by[static_cast<std::size_t>(std::ranges::find(goals_, fact) - goals_.begin())];
      if (list.empty() || list.back() != action.start) list.push_back(action.start);
    };
    std::ranges::for_each(task.deletes[action.start], note);
    std::ranges::for_each(task.deletes[action.end], note);
  }
  for (const auto& list : undone_by) undone_by_.push_back(list);
}

void OperatorCosts::set(StateView state) {
  for (const SnapId op : raised_) costs_[op] = 1;
  raised_.clear();
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (!task_.layout.holds(state, goals_[i])) continue;
    for (const SnapId op : undone_by_[i]) {
      costs_[op] += kGoalThreatPenalty;
      raised_.push_back(op);
    }
  }
}

}  // namespace roci::planner::temporal_pddl::heuristics
