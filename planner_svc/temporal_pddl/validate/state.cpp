#include "planner_svc/temporal_pddl/validate/state.hpp"

#include <cmath>

namespace roci::planner::temporal_pddl::validate {

using pddl::AssignmentOperator;

bool is_additive(AssignmentOperator op) {
  return op == AssignmentOperator::increase || op == AssignmentOperator::decrease;
}

namespace {

double changed(double value, const NumericChange& change) {
  switch (change.op) {
    case AssignmentOperator::increase:
      return value + change.operand;
    case AssignmentOperator::decrease:
      return value - change.operand;
    case AssignmentOperator::scale_up:
      return value * change.operand;
    case AssignmentOperator::scale_down:
      return value / change.operand;
    case AssignmentOperator::assign:
      break;
  }
  return change.operand;
}

}  // namespace

bool apply(const Changes& changes, State& state, std::string& fluent) {
  for (const std::string& fact : changes.deleted) state.facts.erase(fact);
  for (const std::string& fact : changes.added) state.facts.insert(fact);
  bool all = true;
  for (const NumericChange& change : changes.numeric) {
    const auto it = state.values.find(change.fluent);
    const bool defined = it != state.values.end() || change.op == AssignmentOperator::assign;
    const double value = defined ? changed(it == state.values.end() ? 0 : it->second, change) : 0;
    if (defined && std::isfinite(value)) {
      state.values[change.fluent] = value;
    } else {
      fluent = change.fluent;
      all = false;
    }
  }
  return all;
}

}  // namespace roci::planner::temporal_pddl::validate
