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

// Joins the parts of a conjunction (decisive no) or disjunction (decisive yes).
class Junction {
 public:
  Junction(Truth decisive, bool ask_all)
      : decisive_(decisive), ask_all_(ask_all), result_(negation(decisive)) {}

  // Returns false when no further part can matter.
  bool take(Truth part) {
    if (part == Truth::unknown && result_ != decisive_) result_ = part;
    if (part != decisive_) return true;
    result_ = decisive_;
    return ask_all_;
  }

  Truth result() const { return result_; }

 private:
  Truth decisive_;
  bool ask_all_;  // what is read is wanted of each part
  Truth result_;
};

}  // namespace

Truth Evaluator::combine(Truth decisive, const std::vector<pddl::Condition>& parts, Bindings& bindings) {
  Junction junction(decisive, reads_ != nullptr);
  for (const pddl::Condition& part : parts)
    if (!junction.take(evaluate(part, bindings))) break;
  return junction.result();
}

Truth Evaluator::combine(Truth decisive, const std::vector<pddl::TypedName>& variables,
                         const pddl::Condition& body, Bindings& bindings) {
  Junction junction(decisive, reads_ != nullptr);
  model_.for_each_choice(variables, bindings, [&] { return junction.take(evaluate(body, bindings)); });
  return junction.result();
}

Truth Evaluator::imply(const pddl::Imply& imply, Bindings& bindings) {
  Junction junction(Truth::yes, reads_ != nullptr);
  if (junction.take(negation(evaluate(*imply.premise, bindings))))
    junction.take(evaluate(*imply.conclusion, bindings));
  return junction.result();
}

Truth Evaluator::evaluate(const pddl::Condition& condition, Bindings& bindings) {
  return std::visit(
      pddl::Overloaded{[&](const pddl::And& all) { return combine(Truth::no, all.parts, bindings); },
                       [&](const pddl::Or& any) { return combine(Truth::yes, any.parts, bindings); },
                       [&](const pddl::Not& negated) { return negation(evaluate(*negated.body, bindings)); },
                       [&](const pddl::Imply& implication) { return imply(implication, bindings); },
                       [&](const pddl::Forall& forall) {
                         return combine(Truth::no, forall.variables, *forall.body, bindings);
                       },
                       [&](const pddl::Exists& exists) {
                         return combine(Truth::yes, exists.variables, *exists.body, bindings);
                       },
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
