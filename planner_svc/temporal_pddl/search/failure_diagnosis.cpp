#include "planner_svc/temporal_pddl/search/failure_diagnosis.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

namespace roci::planner::temporal_pddl::search {

using task::ActionId, task::Comparator, task::FactId, task::Goal, task::IdVector, task::LinearExpression,
    task::NumbersView, task::NumericCondition, task::SnapId, task::StateView, task::Task;

namespace {

// Is a comparison as in "(battery) >= 30", its sum without the constant on the left.
struct Inequality {
  LinearExpression left;
  const char* relation = ">=";
  double right = 0;
  bool from_above = false;  // the left must not be more

  Inequality(const LinearExpression& expression, Comparator comparator)
      : left(expression), right(-expression.constant) {
    left.constant = 0;
    from_above = std::ranges::all_of(left.terms, [](const auto& term) { return term.weight < 0; });
    if (from_above) {
      left = scaled(left, -1);
      right = expression.constant;
    }
    const bool strict = comparator == Comparator::greater;
    relation = comparator == Comparator::equal ? "=" : from_above ? strict ? "<" : "<=" : strict ? ">" : ">=";
  }
};

std::string text(const Task& task, const Inequality& inequality) {
  std::ostringstream out;
  const char* plus = "";
  for (const auto& term : inequality.left.terms) {
    out << plus;
    if (term.weight != 1) out << term.weight << " * ";
    out << task.number_names[term.variable.index()];
    plus = " + ";
  }
  out << ' ' << inequality.relation << ' ' << inequality.right;
  return out.str();
}

class FailureDiagnosis {
 public:
  FailureDiagnosis(const Task& task, const StateStore& store)
      : task_(task),
        store_(store),
        held_(task.fact_names.size(), false),
        asked_(task.fact_names.size(), false) {
    for (std::size_t node = 0; node < store.size(); ++node) note(store.state(NodeId(node)));
  }

  std::string find() {
    for (const Goal& goal : task_.goals) {
      for (const auto& comparison : goal.comparisons) {
        if (const auto found = unmet(comparison)) return "the goal needs " + *found;
      }
      ask(goal.facts);
    }
    while (!open_.empty()) {
      const FactId wanted = open_.back();
      open_.pop_back();
      for (std::size_t i = 0; i < task_.snaps.size(); ++i) {
        if (std::ranges::count(task_.adds[i], wanted) == 0) continue;
        if (auto found = blocked(SnapId(i))) return *found;
      }
    }
    return {};
  }

 private:
  void note(StateView state) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
      if (!held_[FactId(i)]) held_[FactId(i)] = task_.layout.holds(state, FactId(i));
    }
  }

  void ask(std::span<const FactId> facts) {
    for (const FactId fact : facts) {
      if (held_[fact] || asked_[fact]) continue;
      asked_[fact] = true;
      open_.push_back(fact);
    }
  }

  // Returns a comparison of the action that no state meets; else it asks for the action's facts that no state
  // has.
  std::optional<std::string> blocked(SnapId snap) {
    const ActionId action = task_.snaps[snap].action;
    if (action.is_none()) {
      ask(task_.conditions[snap]);
      return std::nullopt;
    }
    for (const SnapId step : {task_.actions[action].start, task_.actions[action].end}) {
      ask(task_.conditions[step]);
      for (const auto& comparison : task_.comparisons[step]) {
        if (const auto found = unmet(comparison)) return name(task_, action) + " needs " + *found;
      }
    }
    ask(task_.invariants[action]);
    return std::nullopt;
  }

  // Returns the comparison and how near the states came, if none meets it.
  std::optional<std::string> unmet(const NumericCondition& condition) const {
    const LinearExpression& expression = task_.expressions[condition.expression];
    if (expression.duration_weight != 0 || expression.terms.empty()) return std::nullopt;
    const Inequality inequality(expression, condition.comparator);
    std::optional<double> nearest;
    for (std::size_t node = 0; node < store_.size(); ++node) {
      const NumbersView numbers = task_.layout.numbers(store_.state(NodeId(node)));
      if (holds(condition.comparator, evaluate(expression, numbers, 0))) return std::nullopt;
      const double left = evaluate(inequality.left, numbers, 0);
      const bool nearer = !nearest || (inequality.from_above ? left < *nearest : left > *nearest);
      if (nearer) nearest = left;
    }
    std::ostringstream out;
    out << text(task_, inequality);
    if (condition.comparator == Comparator::equal) {
      out << ", which it never is";
    } else if (nearest) {
      out << ": never " << (inequality.from_above ? "less" : "more") << " than " << *nearest;
    }
    return out.str();
  }

  const Task& task_;
  const StateStore& store_;
  IdVector<FactId, bool> held_, asked_;
  std::vector<FactId> open_;
};

}  // namespace

std::string unmet_comparison(const Task& task, const StateStore& store) {
  return task.layout.numbers() == 0 ? std::string() : FailureDiagnosis(task, store).find();
}

}  // namespace roci::planner::temporal_pddl::search
