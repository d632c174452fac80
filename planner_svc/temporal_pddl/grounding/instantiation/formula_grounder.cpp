#include "planner_svc/temporal_pddl/grounding/instantiation/formula_grounder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/lifted/model_failure.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

using lifted::Binding, lifted::LiftedAtom, lifted::LiftedExpression, lifted::LiftedFormula,
    lifted::ModelFailure, lifted::for_each_value, lifted::objects_of;
using task::Comparator, task::FunctionId, task::LinearExpression, task::NumberId, task::ObjectId,
    task::PredicateId;
using temporal::Verdict;

namespace {

using Kind = LiftedFormula::Kind;

bool implies(const Conjunction& stronger, const Conjunction& weaker) {
  return std::ranges::includes(stronger.literals, weaker.literals) &&
         std::ranges::includes(stronger.comparisons, weaker.comparisons);
}

// Drops alternatives that another one makes superfluous.
Disjunction simplified(Disjunction alternatives) {
  std::ranges::sort(alternatives);
  alternatives.erase(std::unique(alternatives.begin(), alternatives.end()), alternatives.end());
  Disjunction result;
  for (const auto& candidate : alternatives) {
    const bool superfluous = std::ranges::any_of(alternatives, [&](const Conjunction& other) {
      return &other != &candidate && implies(candidate, other);
    });
    if (!superfluous) result.push_back(candidate);
  }
  return result;
}

}  // namespace

bool has_choice(const LiftedFormula& formula) {
  return formula.kind == Kind::disjunction || formula.kind == Kind::exists ||
         std::ranges::any_of(formula.parts, has_choice);
}

Disjunction always() { return {Conjunction{}}; }

bool is_certain(const Disjunction& alternatives) {
  return alternatives.size() == 1 && alternatives.front().empty();
}

std::optional<Conjunction> merged(const Conjunction& a, const Conjunction& b) {
  Conjunction result;
  std::ranges::set_union(a.literals, b.literals, std::back_inserter(result.literals));
  std::ranges::set_union(a.comparisons, b.comparisons, std::back_inserter(result.comparisons));
  for (std::size_t i = 1; i < result.literals.size(); ++i) {
    if (result.literals[i - 1].atom == result.literals[i].atom) return std::nullopt;
  }
  return result;
}

Disjunction both(const Disjunction& a, const Disjunction& b) {
  Disjunction result;
  for (const auto& left : a) {
    for (const auto& right : b) {
      if (auto conjunction = merged(left, right)) result.push_back(std::move(*conjunction));
    }
  }
  return result.size() > 1 ? simplified(std::move(result)) : result;
}

Disjunction either(Disjunction a, const Disjunction& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a.size() > 1 ? simplified(std::move(a)) : a;
}

Disjunction FormulaGrounder::ground(const LiftedFormula& formula, Binding& binding) {
  Disjunction result;
  const auto conjoin = [&](const LiftedFormula& part) {
    if (result.empty()) return;
    const bool is_literal = part.kind == Kind::atom || part.kind == Kind::not_atom;
    if (is_literal && result.size() == 1) return conjoin_atom(part, binding, result);
    const Disjunction more = ground(part, binding);
    if (!is_certain(more)) result = is_certain(result) ? more : both(result, more);
    if (result.size() > kMaxAlternatives) {
      fail(part.where, "the condition has over " + std::to_string(kMaxAlternatives) + " alternatives",
           "split the action or replace the disjunction by a predicate");
    }
  };
  const auto disjoin = [&](const LiftedFormula& part) {
    if (!is_certain(result)) result = either(std::move(result), ground(part, binding));
  };
  switch (formula.kind) {
    case Kind::conjunction:
      result = always();
      for (const auto& part : formula.parts) conjoin(part);
      return result;
    case Kind::disjunction:
      for (const auto& part : formula.parts) disjoin(part);
      return result;
    case Kind::forall:
      result = always();
      for_each_value(formula.quantified, binding, [&] { conjoin(formula.parts.front()); });
      return result;
    case Kind::exists:
      for_each_value(formula.quantified, binding, [&] { disjoin(formula.parts.front()); });
      return result;
    case Kind::atom:
    case Kind::not_atom:
      return ground_atom(formula, binding);
    case Kind::equal:
    case Kind::not_equal:
      return static_model_.possible(formula, binding) ? always() : Disjunction{};
    case Kind::comparison:
      return ground_comparison(formula, binding);
  }
  return result;
}

// Does what both(result, ground_atom(formula, binding)) would, in place.
void FormulaGrounder::conjoin_atom(const LiftedFormula& formula, const Binding& binding,
                                   Disjunction& result) const {
  GroundLiteral literal;
  const Truth truth = decide(formula, binding, literal);
  if (truth == Truth::no) return result.clear();
  if (truth == Truth::yes) return;
  auto& literals = result.front().literals;
  const auto place = std::ranges::lower_bound(literals, GroundLiteral{literal.atom, false});
  if (place == literals.end() || place->atom != literal.atom) {
    literals.insert(place, literal);
  } else if (place->negated != literal.negated) {
    result.clear();
  }
}

FormulaGrounder::Truth FormulaGrounder::decide(const LiftedFormula& formula, const Binding& binding,
                                               GroundLiteral& literal) const {
  const bool positive = formula.kind == Kind::atom;
  const auto atom = reached_atom(formula.atom, binding);
  if (!atom) return positive ? Truth::no : Truth::yes;
  const PredicateId predicate = formula.atom.predicate;
  const auto objects = reachability_.atoms.objects(*atom);
  if (static_model_.holds_initially(predicate, objects) && !touched_.find(predicate.value, objects))
    return positive ? Truth::yes : Truth::no;
  literal = {*atom, !positive};
  return Truth::open;
}

Disjunction FormulaGrounder::ground_atom(const LiftedFormula& formula, const Binding& binding) const {
  GroundLiteral literal;
  const Truth truth = decide(formula, binding, literal);
  if (truth == Truth::open) return {Conjunction{{literal}, {}}};
  return truth == Truth::yes ? always() : Disjunction{};
}

void FormulaGrounder::read(const LiftedFormula& formula, Binding& binding, bool at_end,
                           std::vector<ReadVariable>& result) {
  switch (formula.kind) {
    case Kind::conjunction:
    case Kind::disjunction:
      for (const auto& part : formula.parts) read(part, binding, at_end, result);
      return;
    case Kind::forall:
    case Kind::exists:
      for_each_value(formula.quantified, binding,
                     [&] { read(formula.parts.front(), binding, at_end, result); });
      return;
    case Kind::atom:
    case Kind::not_atom:
      if (static_model_.is_static(formula.atom.predicate)) return;
      if (const auto atom = known_atom(formula.atom, binding)) result.push_back({*atom, false, at_end});
      return;
    case Kind::comparison:
      for (const auto& side : formula.sides) read(side, binding, at_end, result);
      return;
    case Kind::equal:
    case Kind::not_equal:
      return;
  }
}

void FormulaGrounder::read(const LiftedExpression& expression, const Binding& binding, bool at_end,
                           std::vector<ReadVariable>& result) {
  if (expression.kind == LiftedExpression::Kind::function &&
      !static_model_.constants().is_constant(expression.function)) {
    const NumberId read = number(expression.function, objects_of(expression.arguments, binding));
    result.push_back({read.value, true, at_end});
  }
  for (const auto& operand : expression.operands) read(operand, binding, at_end, result);
}

Disjunction FormulaGrounder::ground_comparison(const LiftedFormula& formula, const Binding& binding) {
  const auto left = linear(formula.sides[0], binding);
  const auto right = linear(formula.sides[1], binding);
  if (!left || !right) return {};
  const auto difference = [&](const LinearExpression& a, const LinearExpression& b) {
    return sum(a, scaled(b, -1));
  };
  LinearExpression expression = difference(*left, *right);
  Comparator comparator = Comparator::equal;
  switch (formula.comparison) {
    case pddl::ComparisonOperator::less:
    case pddl::ComparisonOperator::less_equal:
      expression = difference(*right, *left);
      [[fallthrough]];
    case pddl::ComparisonOperator::greater:
    case pddl::ComparisonOperator::greater_equal:
      comparator = formula.comparison == pddl::ComparisonOperator::less ||
                           formula.comparison == pddl::ComparisonOperator::greater
                       ? Comparator::greater
                       : Comparator::greater_equal;
      break;
    case pddl::ComparisonOperator::equal:
      break;
  }
  if (expression.is_constant()) return holds(comparator, expression.constant) ? always() : Disjunction{};
  return {Conjunction{{}, {{expressions_.intern(expression), comparator}}}};
}

std::optional<LinearExpression> FormulaGrounder::linear(const LiftedExpression& expression,
                                                        const Binding& binding) {
  std::vector<NumberId> cancelled;
  auto result = linear_form(expression, binding, cancelled);
  if (!result) return result;
  for (const NumberId number : cancelled) {
    const auto place = std::ranges::lower_bound(result->terms, number, {}, &LinearExpression::Term::variable);
    const bool stands = place != result->terms.end() && place->variable == number;
    if (!stands && !begins_with_value(number)) result->terms.insert(place, {number, 0});
  }
  return result;
}

bool FormulaGrounder::begins_with_value(NumberId number) {
  const lifted::Symbols& symbols = static_model_.symbols();
  if (!valued_) {
    valued_.emplace();
    for (const auto& value : problem_.values) {
      std::vector<ObjectId> objects;
      for (const auto& term : value.fluent.arguments) objects.push_back(symbols.object(term.name));
      valued_->intern(symbols.function(value.fluent.symbol).value, objects);
    }
    if (const auto total_cost = symbols.total_cost()) valued_->intern(total_cost->value, {});
  }
  return valued_->find(numbers_.symbol(number.value), numbers_.objects(number.value)).has_value();
}

std::optional<LinearExpression> FormulaGrounder::combined(const LiftedExpression& expression,
                                                          const LinearExpression& left,
                                                          const LinearExpression& right) const {
  switch (expression.op) {
    case pddl::ArithmeticOperator::add:
      return sum(left, right);
    case pddl::ArithmeticOperator::subtract:
      return sum(left, scaled(right, -1));
    case pddl::ArithmeticOperator::multiply:
      if (!left.is_constant() && !right.is_constant()) {
        fail(expression.where, "a product of numbers that change is not linear",
             "make one factor a constant");
      }
      return right.is_constant() ? scaled(left, right.constant) : scaled(right, left.constant);
    case pddl::ArithmeticOperator::divide:
      break;
  }
  if (!right.is_constant()) {
    fail(expression.where, "division by a number that changes is not linear", "make the divisor a constant");
  }
  if (right.constant == 0) return std::nullopt;
  LinearExpression quotient = scaled(left, 1 / right.constant);
  quotient.constant = left.constant / right.constant;  // as it is rounded once
  return quotient;
}

std::optional<LinearExpression> FormulaGrounder::linear_form(const LiftedExpression& expression,
                                                             const Binding& binding,
                                                             std::vector<NumberId>& cancelled) {
  LinearExpression result;
  const auto note_cancelled = [&](const LinearExpression& part) {
    for (const auto& term : part.terms)
      if (std::ranges::count(result.terms, term.variable, &LinearExpression::Term::variable) == 0)
        cancelled.push_back(term.variable);
  };
  switch (expression.kind) {
    case LiftedExpression::Kind::number:
      result.constant = expression.number;
      return result;
    case LiftedExpression::Kind::duration:
      result.duration_weight = 1;
      return result;
    case LiftedExpression::Kind::function: {
      if (static_model_.constants().is_constant(expression.function)) {
        const auto value = static_model_.constant_value(expression, binding);
        if (!value) return std::nullopt;
        result.constant = *value;
      } else {
        result.terms.push_back({number(expression.function, objects_of(expression.arguments, binding)), 1});
      }
      return result;
    }
    case LiftedExpression::Kind::arithmetic:
      break;
  }
  for (std::size_t i = 0; i < expression.operands.size(); ++i) {
    const auto operand = linear_form(expression.operands[i], binding, cancelled);
    if (!operand) return std::nullopt;
    const LinearExpression before = std::move(result);
    if (i == 0) {
      const bool negation =
          expression.op == pddl::ArithmeticOperator::subtract && expression.operands.size() == 1;
      result = negation ? scaled(*operand, -1) : *operand;
      continue;
    }
    const auto both = combined(expression, before, *operand);
    if (!both) return std::nullopt;
    result = *both;
    if (result.terms.size() == before.terms.size() + operand->terms.size()) continue;
    note_cancelled(before);
    note_cancelled(*operand);
  }
  if (!std::isfinite(result.constant)) return std::nullopt;
  return result;
}

std::optional<std::uint32_t> FormulaGrounder::reached_atom(const LiftedAtom& atom,
                                                           const Binding& binding) const {
  const auto found = reachability_.atoms.find(atom.predicate.value, objects_of(atom.arguments, binding));
  return found && reachability_.reached[*found] ? found : std::nullopt;
}

std::optional<std::uint32_t> FormulaGrounder::known_atom(const LiftedAtom& atom,
                                                         const Binding& binding) const {
  return reachability_.atoms.find(atom.predicate.value, objects_of(atom.arguments, binding));
}

NumberId FormulaGrounder::number(FunctionId function, std::span<const ObjectId> objects) {
  return NumberId(numbers_.intern(function.value, objects));
}

void FormulaGrounder::fail(pddl::SourceLocation where, const std::string& message,
                           const std::string& remedy) const {
  throw ModelFailure(Verdict::unsupported, pddl::Diagnostic{file_, where, message, remedy});
}

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
