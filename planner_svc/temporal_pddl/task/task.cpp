#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::task {

namespace {

std::string application(const Task& task, const std::string& symbol, std::span<const ObjectId> arguments) {
  std::string text = "(" + symbol;
  for (const ObjectId argument : arguments) text += " " + task.objects[argument.index()];
  return text + ")";
}

}  // namespace

SnapId Task::other_end(SnapId snap) const {
  if (snaps[snap].action.is_none()) return {};
  const Action& action = actions[snaps[snap].action];
  if (action.instantaneous()) return {};
  return snap == action.start ? action.end : action.start;
}

std::size_t Task::bytes() const {
  const auto sum = [](const auto&... lists) { return (lists.bytes() + ...); };
  return sum(fact_names, atom_arguments, action_arguments, snaps, conditions, comparisons, adds, deletes,
             numeric_effects, reads, writes, windows, actions, invariants, numeric_invariants,
             invariant_reads, span_windows, duration_rules, derived_invariant_reads, absent_for_compression,
             derived_goal_reads, is_derived, layout);
}

std::string name(const Task& task, FactId fact) {
  const FactName& fact_name = task.fact_names[fact];
  const std::string text = application(task, task.predicates[fact_name.predicate.index()],
                                       task.atom_arguments[std::size_t{fact_name.atom}]);
  return fact_name.negated ? "(not " + text + ")" : text;
}

std::string name(const Task& task, ActionId action) {
  return application(task, task.schemas[task.actions[action].schema.index()], task.action_arguments[action]);
}

bool Task::has_absolute_times() const {
  if (!timed_steps.empty()) return true;
  for (std::size_t i = 0; i < snaps.size(); ++i) {
    if (!windows[i].empty()) return true;
  }
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (!span_windows[i].empty()) return true;
  }
  return false;
}

}  // namespace roci::planner::temporal_pddl::task
