#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::temporal_pddl::grounding::lifted {

using task::ObjectId;
using task::PredicateId;

namespace {

using Kind = LiftedFormula::Kind;

std::vector<ObjectId> objects_of(const pddl::Atom& atom, const Symbols& symbols) {
  std::vector<ObjectId> result;
  for (const auto& term : atom.arguments) result.push_back(symbols.object(term.name));
  return result;
}

}  // namespace

StaticModel::StaticModel(const pddl::Problem& problem, const std::vector<LiftedAction>& actions,
                         const Symbols& symbols, const ConstantFunctions& constants)
    : symbols_(symbols),
      constants_(constants),
      static_(symbols.predicates(), true),
      derived_(symbols.predicates(), false) {
  for (const auto& action : actions) {
    if (action.layer) derived_[action.start_effects.front().atom.predicate] = true;
    for (const auto* effects : {&action.start_effects, &action.end_effects}) {
      for (const auto& effect : *effects) {
        if (effect.kind != LiftedEffect::Kind::numeric) static_[effect.atom.predicate] = false;
      }
    }
  }
  TupleTable deleted_at_zero;
  for (const auto& timed : problem.timed_literals) {
    const auto& atom = timed.literal.atom;
    if (timed.time <= 0 && timed.literal.negated) {
      deleted_at_zero.intern(symbols.predicate(atom.symbol).value, objects_of(atom, symbols));
    }
  }
  for (const auto& fact : problem.facts) {
    const std::uint32_t predicate = symbols.predicate(fact.symbol).value;
    const auto objects = objects_of(fact, symbols);
    if (!deleted_at_zero.find(predicate, objects)) initial_.intern(predicate, objects);
  }
  for (const auto& timed : problem.timed_literals) {
    const PredicateId predicate = symbols.predicate(timed.literal.atom.symbol);
    static_[predicate] = false;
    auto objects = objects_of(timed.literal.atom, symbols);
    if (timed.time > 0) {
      timed_.push_back({timed.time, predicate, std::move(objects), timed.literal.negated});
    } else if (!timed.literal.negated) {
      initial_.intern(predicate.value, objects);
    }
  }
  std::stable_sort(timed_.begin(), timed_.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
}

bool StaticModel::possible(const LiftedFormula& formula, Binding& binding) const {
  const auto part_possible = [&](const LiftedFormula& part) { return possible(part, binding); };
  switch (formula.kind) {
    case Kind::conjunction:
      return std::ranges::all_of(formula.parts, part_possible);
    case Kind::disjunction:
      return std::ranges::any_of(formula.parts, part_possible);
    case Kind::forall: {
      bool all = true;
      for_each_value(formula.quantified, binding, [&] { all = all && part_possible(formula.parts.front()); });
      return all;
    }
    case Kind::exists: {
      bool any = false;
      for_each_value(formula.quantified, binding, [&] { any = any || part_possible(formula.parts.front()); });
      return any;
    }
    case Kind::atom:
    case Kind::not_atom: {
      if (!is_static(formula.atom.predicate)) return true;
      const auto objects = lifted::objects_of(formula.atom.arguments, binding);
      return holds_initially(formula.atom.predicate, objects) == (formula.kind == Kind::atom);
    }
    case Kind::equal:
    case Kind::not_equal: {
      const auto& arguments = formula.atom.arguments;
      return (resolve(arguments[0], binding) == resolve(arguments[1], binding)) ==
             (formula.kind == Kind::equal);
    }
    case Kind::comparison: {
      if (!defined(formula.sides[0], binding) || !defined(formula.sides[1], binding)) return false;
      const auto left = constant_value(formula.sides[0], binding);
      const auto right = constant_value(formula.sides[1], binding);
      return !left || !right || compare(formula.comparison, *left, *right);
    }
  }
  return true;
}

bool StaticModel::defined(const LiftedExpression& expression, const Binding& binding) const {
  if (expression.kind == LiftedExpression::Kind::function && constants_.is_constant(expression.function)) {
    return constants_.value(expression.function, lifted::objects_of(expression.arguments, binding))
        .has_value();
  }
  return std::ranges::all_of(expression.operands,
                             [&](const LiftedExpression& operand) { return defined(operand, binding); });
}

std::optional<double> StaticModel::constant_value(const LiftedExpression& expression,
                                                  const Binding& binding) const {
  switch (expression.kind) {
    case LiftedExpression::Kind::number:
      return expression.number;
    case LiftedExpression::Kind::duration:
      return std::nullopt;
    case LiftedExpression::Kind::function:
      if (!constants_.is_constant(expression.function)) return std::nullopt;
      return constants_.value(expression.function, lifted::objects_of(expression.arguments, binding));
    case LiftedExpression::Kind::arithmetic: {
      std::vector<double> operands;
      for (const auto& operand : expression.operands) {
        const auto value = constant_value(operand, binding);
        if (!value) return std::nullopt;
        operands.push_back(*value);
      }
      const double value = combine(expression.op, operands);
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    }
  }
  return std::nullopt;
}

Objects objects_of(const std::vector<Argument>& arguments, const Binding& binding) {
  Objects result;
  result.reserve(arguments.size());
  result.set_size(arguments.size());
  for (std::size_t i = 0; i < arguments.size(); ++i) result[i] = resolve(arguments[i], binding);
  return result;
}

bool compare(pddl::ComparisonOperator op, double left, double right) {
  switch (op) {
    case pddl::ComparisonOperator::less:
      return left < right;
    case pddl::ComparisonOperator::less_equal:
      return left <= right;
    case pddl::ComparisonOperator::equal:
      return std::abs(left - right) <= 1e-9;
    case pddl::ComparisonOperator::greater_equal:
      return left >= right;
    case pddl::ComparisonOperator::greater:
      return left > right;
  }
  return false;
}

double combine(pddl::ArithmeticOperator op, const std::vector<double>& operands) {
  double result = operands.front();
  if (op == pddl::ArithmeticOperator::subtract && operands.size() == 1) return -result;
  for (std::size_t i = 1; i < operands.size(); ++i) {
    switch (op) {
      case pddl::ArithmeticOperator::add:
        result += operands[i];
        break;
      case pddl::ArithmeticOperator::subtract:
        result -= operands[i];
        break;
      case pddl::ArithmeticOperator::multiply:
        result *= operands[i];
        break;
      case pddl::ArithmeticOperator::divide:
        result /= operands[i];
        break;
    }
  }
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
