#include "exec_svc/problem/closed_world.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/stratify.hpp"

namespace roci::exec::problem {
namespace {

using temporal::Truth;
using Binding = std::map<std::string, std::string>;
using Values = std::map<std::string, double>;

Truth of(bool holds) { return holds ? Truth::yes : Truth::no; }

Truth opposite(Truth truth) {
  if (truth == Truth::unknown) return truth;
  return truth == Truth::yes ? Truth::no : Truth::yes;
}

std::string name_of(const pddl::Term& term, const Binding& binding) {
  const auto bound = binding.find(term.name);
  return bound == binding.end() ? term.name : bound->second;
}

std::string text_of(const pddl::Atom& atom, const Binding& binding) {
  std::string out = "(" + atom.symbol;
  for (const pddl::Term& term : atom.arguments) out += " " + name_of(term, binding);
  return out + ")";
}

std::optional<double> value_of(const pddl::Expression& expression, const Values& values,
                               const Binding& binding);

std::optional<double> value_of(const pddl::Arithmetic& sum, const Values& values, const Binding& binding) {
  std::optional<double> out;
  for (const pddl::Expression& operand : sum.operands) {
    const auto value = value_of(operand, values, binding);
    if (!value) return std::nullopt;
    if (!out) {
      out = sum.operands.size() == 1 ? -*value : *value;
      continue;
    }
    switch (sum.op) {
      case pddl::ArithmeticOperator::add:
        *out += *value;
        break;
      case pddl::ArithmeticOperator::subtract:
        *out -= *value;
        break;
      case pddl::ArithmeticOperator::multiply:
        *out *= *value;
        break;
      case pddl::ArithmeticOperator::divide:
        if (*value == 0) return std::nullopt;
        *out /= *value;
        break;
    }
  }
  return out;
}

std::optional<double> value_of(const pddl::Expression& expression, const Values& values,
                               const Binding& binding) {
  if (const auto* number = std::get_if<pddl::Number>(&expression.node)) return number->value;
  if (const auto* sum = std::get_if<pddl::Arithmetic>(&expression.node))
    return value_of(*sum, values, binding);
  const auto* fluent = std::get_if<pddl::Atom>(&expression.node);
  if (fluent == nullptr) return std::nullopt;
  const auto value = values.find(text_of(*fluent, binding));
  return value == values.end() ? std::nullopt : std::optional(value->second);
}

bool compares(pddl::ComparisonOperator op, double left, double right) {
  switch (op) {
    case pddl::ComparisonOperator::less:
      return left < right;
    case pddl::ComparisonOperator::less_equal:
      return left <= right;
    case pddl::ComparisonOperator::equal:
      return left == right;
    case pddl::ComparisonOperator::greater_equal:
      return left >= right;
    case pddl::ComparisonOperator::greater:
      return left > right;
  }
  return false;
}

}  // namespace

ClosedWorld::ClosedWorld(const pddl::Domain& domain, const pddl::Problem& problem)
    : domain_(domain), objects_(domain, problem) {
  for (const pddl::Atom& fact : problem.facts) facts_.insert(text_of(fact, {}));
  for (const pddl::InitialValue& value : problem.values) values_[text_of(value.fluent, {})] = value.value;
  if (!domain.derived.empty()) derive();
}

void ClosedWorld::derive() {
  const pddl::Strata strata = pddl::stratify(domain_);
  for (int layer = 0; layer < pddl::kMaxLayers; ++layer) {
    for (bool more = true; more;) {
      more = false;
      for (const pddl::DerivedPredicate& rule : domain_.derived)
        if (strata.layer.at(rule.head.name) == layer && fire(rule)) more = true;
    }
  }
}

// Adds what the rule says of every choice of objects. Returns whether something was new.
bool ClosedWorld::fire(const pddl::DerivedPredicate& rule) {
  const std::size_t before = facts_.size();
  pddl::Atom head{rule.head.name, {}, {}};
  for (const pddl::TypedName& parameter : rule.head.parameters)
    head.arguments.push_back({parameter.name, {}});
  Binding binding;
  const std::function<void(std::size_t)> choose = [&](std::size_t next) {
    if (next == rule.head.parameters.size()) {
      std::string fact = text_of(head, binding);
      if (!facts_.contains(fact) && truth_of(rule.body, binding) == Truth::yes)
        facts_.insert(std::move(fact));
      return;
    }
    const pddl::TypedName& parameter = rule.head.parameters[next];
    for (const int object : objects_.of_types(parameter.types)) {
      binding[parameter.name] = objects_[static_cast<std::size_t>(object)].name;
      choose(next + 1);
    }
    binding.erase(parameter.name);
  };
  choose(0);
  return facts_.size() > before;
}

Truth ClosedWorld::truth_of(const pddl::Condition& condition) const { return truth_of(condition, {}); }

Truth ClosedWorld::of_all(const std::vector<pddl::Condition>& parts, const Binding& binding) const {
  Truth out = Truth::yes;
  for (const pddl::Condition& part : parts) out = std::min(out, truth_of(part, binding));
  return out;
}

Truth ClosedWorld::for_all(const std::vector<pddl::TypedName>& variables, std::size_t next,
                           const pddl::Condition& body, Binding& binding, bool negated) const {
  if (next == variables.size()) return negated ? opposite(truth_of(body, binding)) : truth_of(body, binding);
  Truth out = Truth::yes;
  for (const int object : objects_.of_types(variables[next].types)) {
    Binding with = binding;
    with[variables[next].name] = objects_[static_cast<std::size_t>(object)].name;
    out = std::min(out, for_all(variables, next + 1, body, with, negated));
    if (out == Truth::no) break;
  }
  return out;
}

Truth ClosedWorld::truth_of(const pddl::Condition& condition, const Binding& binding) const {
  return std::visit(pddl::Overloaded{
                        [&](const pddl::Atom& fact) { return of(facts_.contains(text_of(fact, binding))); },
                        [&](const pddl::And& all) { return of_all(all.parts, binding); },
                        [&](const pddl::Or& any) {
                          Truth out = Truth::no;
                          for (const pddl::Condition& part : any.parts)
                            out = std::max(out, truth_of(part, binding));
                          return out;
                        },
                        [&](const pddl::Not& negated) { return opposite(truth_of(*negated.body, binding)); },
                        [&](const pddl::Imply& imply) {
                          return std::max(opposite(truth_of(*imply.premise, binding)),
                                          truth_of(*imply.conclusion, binding));
                        },
                        [&](const pddl::Forall& all) {
                          Binding inner = binding;
                          return for_all(all.variables, 0, *all.body, inner, false);
                        },
                        [&](const pddl::Exists& some) {
                          Binding inner = binding;
                          return opposite(for_all(some.variables, 0, *some.body, inner, true));
                        },
                        [&](const pddl::TermEquality& same) {
                          return of(name_of(same.left, binding) == name_of(same.right, binding));
                        },
                        [&](const pddl::Comparison& comparison) {
                          const auto left = value_of(comparison.left, values_, binding);
                          const auto right = value_of(comparison.right, values_, binding);
                          return left && right ? of(compares(comparison.op, *left, *right)) : Truth::unknown;
                        },
                    },
                    condition.node);
}

}  // namespace roci::exec::problem
