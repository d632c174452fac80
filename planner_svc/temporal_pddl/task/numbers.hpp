// Numeric conditions and effects are made of linear expressions over numeric state variables (R3, R4).
#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/ids.hpp"

namespace roci::planner::temporal_pddl::task {

/// Holds the sum Σ weight · value(variable) + duration_weight · ?duration + constant. Terms are sorted by
/// variable, and none of their weights is 0.
struct LinearExpression {
  struct Term {
    NumberId variable;
    double weight = 0;
    auto operator<=>(const Term&) const = default;
  };
  std::vector<Term> terms;
  double duration_weight = 0;
  double constant = 0;

  bool is_constant() const { return terms.empty() && duration_weight == 0; }
  auto operator<=>(const LinearExpression&) const = default;
};

/// These return a + b and factor · a, in the form above.
LinearExpression sum(const LinearExpression& a, const LinearExpression& b);
LinearExpression scaled(const LinearExpression& a, double factor);

using Word = std::uint64_t;

/// Shows the values of the numeric variables of one state as they lie in it: one word each.
class NumbersView {
 public:
  explicit NumbersView(std::span<const Word> words) : words_(words) {}
  double operator[](NumberId number) const { return std::bit_cast<double>(words_[number.index()]); }
  std::size_t size() const { return words_.size(); }

 private:
  std::span<const Word> words_;
};

/// Returns the expression's value; `duration` is in seconds. The value is NaN if a variable that it needs
/// has none yet.
double evaluate(const LinearExpression& expression, NumbersView values, double duration);

/// Tells how an expression is compared with 0.
enum class Comparator : std::uint8_t { greater_equal, greater, equal };

/// Compares an expression with 0.
struct NumericCondition {
  ExpressionId expression;
  Comparator comparator = Comparator::greater_equal;
  auto operator<=>(const NumericCondition&) const = default;
};

/// Returns whether the comparison of `difference` with 0 holds. `equal` allows for rounding by 1e-9; a NaN
/// satisfies nothing.
bool holds(Comparator comparator, double difference);

/// Sets the variable to the expression, or adds the expression to it.
struct NumericEffect {
  NumberId variable;
  bool assigns = false;
  ExpressionId expression;
  auto operator<=>(const NumericEffect&) const = default;
};

/// Holds each distinct expression once, as actions of one schema mostly share theirs.
class ExpressionPool {
 public:
  ExpressionId intern(const LinearExpression& expression);
  const LinearExpression& operator[](ExpressionId id) const { return expressions_[id]; }
  std::size_t size() const { return expressions_.size(); }

 private:
  IdVector<ExpressionId, LinearExpression> expressions_;
  std::map<LinearExpression, ExpressionId> ids_;
};

}  // namespace roci::planner::temporal_pddl::task
