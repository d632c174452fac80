#include "planner_svc/temporal_pddl/task/numbers.hpp"

#include <cmath>

namespace roci::planner::temporal_pddl::task {

LinearExpression sum(const LinearExpression& a, const LinearExpression& b) {
  LinearExpression result;
  result.constant = a.constant + b.constant;
  result.duration_weight = a.duration_weight + b.duration_weight;
  auto left = a.terms.begin();
  auto right = b.terms.begin();
  while (left != a.terms.end() || right != b.terms.end()) {
    if (right == b.terms.end() || (left != a.terms.end() && left->variable < right->variable)) {
      result.terms.push_back(*left++);
    } else if (left == a.terms.end() || right->variable < left->variable) {
      result.terms.push_back(*right++);
    } else {
      const double weight = left->weight + right->weight;
      if (weight != 0) result.terms.push_back({left->variable, weight});
      ++left;
      ++right;
    }
  }
  return result;
}

LinearExpression scaled(const LinearExpression& a, double factor) {
  LinearExpression result;
  result.constant = a.constant * factor;
  result.duration_weight = a.duration_weight * factor;
  if (factor != 0) {
    result.terms = a.terms;
    for (auto& term : result.terms) term.weight *= factor;
  }
  return result;
}

double evaluate(const LinearExpression& expression, NumbersView values, double duration) {
  double result = expression.constant;
  for (const auto& term : expression.terms) result += term.weight * values[term.variable];
  if (expression.duration_weight != 0) result += expression.duration_weight * duration;
  return result;
}

bool holds(Comparator comparator, double difference) {
  switch (comparator) {
    case Comparator::greater_equal:
      return difference >= 0;
    case Comparator::greater:
      return difference > 0;
    case Comparator::equal:
      return std::abs(difference) <= 1e-9;
  }
  return false;
}

ExpressionId ExpressionPool::intern(const LinearExpression& expression) {
  const auto known = ids_.find(expression);
  if (known != ids_.end()) return known->second;
  const ExpressionId id = expressions_.push_back(expression);
  ids_.emplace(expression, id);
  return id;
}

}  // namespace roci::planner::temporal_pddl::task
