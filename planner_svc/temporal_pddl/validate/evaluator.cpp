#include "planner_svc/temporal_pddl/validate/evaluator.hpp"

#include <cmath>

#include "core/pddl/overloaded.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

Truth negation(Truth truth) {
  if (truth == Truth::unknown) return truth;
  return truth == Truth::yes ? Truth::no : Truth::yes;
}

Truth as_truth(bool value) { return value ? Truth::yes : Truth::no; }

// Numbers that differ by rounding alone count as equal.
bool compare_numbers(pddl::ComparisonOperator op, double left, double right) {
  const double slack = 1e-9 * std::max({1.0, std::abs(left), std::abs(right)});
  switch (op) {
    case pddl::ComparisonOperator::less:
      return left < right - slack;
    case pddl::ComparisonOperator::less_equal:
      return left <= right + slack;
    case pddl::ComparisonOperator::equal:
      return std::abs(left - right) <= slack;
    case pddl::ComparisonOperator::greater_equal:
      return left >= right - slack;
    case pddl::ComparisonOperator::greater:
      break;
  }
  return left > right + slack;
}

}  // namespace

Truth Evaluator::combine(Truth decisive, Bindings& bindings,
                         const std::function<void(const Part&)>& visit_parts) {
  Truth result = negation(decisive);
  visit_parts([&](const pddl::Condition& part, bool negated) {
    const Truth plain = evaluate(part, bindings);
    const Truth truth = negated ? negation(plain) : plain;
    if (truth == Truth::unknown && result != decisive) result = truth;
    if (truth != decisive) return true;
    result = decisive;
    return reads_ != nullptr;  // the other parts are mentioned too
  });
  return result;
}

Truth Evaluator::combine(Truth decisive, const std::vector<pddl::Condition>& parts, Bindings& bindings) {
  return combine(decisive, bindings, [&](const Part& visit) {
    for (const pddl::Condition& part : parts) {
      if (!visit(part, false)) return;
    }
  });
}

Truth Evaluator::evaluate(const pddl::Condition& condition, Bindings& bindings) {
  const auto quantified = [&](Truth decisive, const auto& quantifier) {
    return combine(decisive, bindings, [&](const Part& visit) {
      model_.for_each_choice(quantifier.variables, bindings, [&] { return visit(*quantifier.body, false); });
    });
  };
  return std::visit(
      pddl::Overloaded{[&](const pddl::And& all) { return combine(Truth::no, all.parts, bindings); },
                       [&](const pddl::Or& any) { return combine(Truth::yes, any.parts, bindings); },
                       [&](const pddl::Not& negated) { return negation(evaluate(*negated.body, bindings)); },
                       [&](const pddl::Imply& imply) {
                         return combine(Truth::yes, bindings, [&](const Part& visit) {
                           if (visit(*imply.premise, true)) visit(*imply.conclusion, false);
                         });
                       },
                       [&](const pddl::Forall& forall) { return quantified(Truth::no, forall); },
                       [&](const pddl::Exists& exists) { return quantified(Truth::yes, exists); },
                       [&](const pddl::Atom& atom) { return fact(atom, bindings); },
                       [&](const pddl::TermEquality& equality) {
                         return as_truth(bindings.object_of(equality.left) ==
                                         bindings.object_of(equality.right));
                       },
                       [&](const pddl::Comparison& comparison) { return compare(comparison, bindings); }},
      condition.node);
}

Truth Evaluator::fact(const pddl::Atom& atom, const Bindings& bindings) {
  const std::string ground = bindings.ground(atom);
  if (!model_.rules(atom.symbol).empty()) return as_truth(derived(atom, ground, bindings));
  if (reads_ && !model_.is_static(atom.symbol)) reads_->facts.push_back(ground);
  return as_truth(state_.facts.contains(ground));
}

Truth Evaluator::compare(const pddl::Comparison& comparison, const Bindings& bindings) {
  const auto left = value(comparison.left, bindings);
  const auto right = value(comparison.right, bindings);
  if (!left || !right) return Truth::unknown;
  return as_truth(compare_numbers(comparison.op, *left, *right));
}

std::optional<double> Evaluator::value(const pddl::Expression& expression, const Bindings& bindings,
                                       const Specials& specials) {
  return std::visit(
      pddl::Overloaded{[](const pddl::Number& number) { return std::optional(number.value); },
                       [&](const pddl::Atom& atom) { return fluent(atom, bindings); },
                       [&](const pddl::DurationVariable&) { return specials.duration; },
                       [&](const pddl::TotalTime&) { return specials.total_time; },
                       [](const pddl::ContinuousTime&) { return std::optional<double>(); },
                       [&](const pddl::Arithmetic& sum) { return arithmetic(sum, bindings, specials); }},
      expression.node);
}

std::nullopt_t Evaluator::undefined(std::string reason) {
  reason_ = std::move(reason);
  return std::nullopt;
}

std::optional<double> Evaluator::fluent(const pddl::Atom& atom, const Bindings& bindings) {
  const std::string ground = bindings.ground(atom);
  if (model_.is_external(atom.symbol)) {
    const auto it = model_.functions().find(ground);
    if (it == model_.functions().end()) return undefined("external function " + ground + " has no value");
    if (!it->second) return undefined("external function " + ground + " is unreachable");
    return *it->second;
  }
  if (reads_ && !model_.is_static(atom.symbol)) reads_->values.push_back(ground);
  const auto it = state_.values.find(ground);
  if (it == state_.values.end()) return undefined(ground + " has no value");
  return it->second;
}

std::optional<double> Evaluator::arithmetic(const pddl::Arithmetic& sum, const Bindings& bindings,
                                            const Specials& specials) {
  std::optional<double> result;
  for (const pddl::Expression& operand : sum.operands) {
    const auto next = value(operand, bindings, specials);
    if (!next) return std::nullopt;
    if (!result) {
      result = *next;
      continue;
    }
    switch (sum.op) {
      case pddl::ArithmeticOperator::add:
        *result += *next;
        break;
      case pddl::ArithmeticOperator::subtract:
        *result -= *next;
        break;
      case pddl::ArithmeticOperator::multiply:
        *result *= *next;
        break;
      case pddl::ArithmeticOperator::divide:
        if (*next == 0) return undefined("division by zero");
        *result /= *next;
        break;
    }
  }
  if (result && sum.operands.size() == 1) return -*result;
  return result;
}

}  // namespace roci::planner::temporal_pddl::validate
