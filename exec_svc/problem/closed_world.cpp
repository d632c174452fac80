#include "exec_svc/problem/closed_world.hpp"

#include <algorithm>
#include <optional>
#include <vector>

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

/// Binds variables to each choice of objects of their types, one after the other; the last one changes fastest.
class Choices {
 public:
  Choices(const pddl::ObjectTable& objects, const std::vector<pddl::TypedName>& variables, Binding& binding)
      : objects_(objects), variables_(variables), binding_(binding), chosen_(variables.size(), 0) {
    for (const pddl::TypedName& variable : variables) candidates_.push_back(objects.of_types(variable.types));
  }

  /// Binds the next choice; false: there is none left.
  bool next() {
    if (!begun_) {
      begun_ = true;
      for (std::size_t i = 0; i < variables_.size(); ++i) {
        if (candidates_[i].empty()) return false;
        bind(i);
      }
      return true;
    }
    for (std::size_t i = variables_.size(); i > 0; --i) {
      const bool more = ++chosen_[i - 1] < candidates_[i - 1].size();
      if (!more) chosen_[i - 1] = 0;
      bind(i - 1);
      if (more) return true;
    }
    return false;
  }

  std::size_t candidates() const {
    std::size_t out = 0;
    for (const std::vector<int>& objects : candidates_) out += objects.size();
    return out;
  }

 private:
  void bind(std::size_t variable) {
    const int object = candidates_[variable][chosen_[variable]];
    binding_[variables_[variable].name] = objects_[static_cast<std::size_t>(object)].name;
  }

  const pddl::ObjectTable& objects_;
  const std::vector<pddl::TypedName>& variables_;
  Binding& binding_;
  std::vector<std::vector<int>> candidates_;  // of each variable
  std::vector<std::size_t> chosen_;           // index into these
  bool begun_ = false;
};

}  // namespace

ClosedWorld::ClosedWorld(const pddl::Domain& domain, const pddl::Problem& problem)
    : domain_(domain), objects_(domain, problem) {
  for (const pddl::Atom& fact : problem.facts) facts_.insert(text_of(fact, {}));
  for (const pddl::InitialValue& value : problem.values) values_[text_of(value.fluent, {})] = value.value;
}

void ClosedWorld::derive() {
  derived_ = true;
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
  deriving_ = &rule;
  const std::size_t before = facts_.size();
  pddl::Atom head{rule.head.name, {}, {}};
  for (const pddl::TypedName& parameter : rule.head.parameters)
    head.arguments.push_back({parameter.name, {}});
  Binding binding;
  Choices choices(objects_, rule.head.parameters, binding);
  if (spend(choices.candidates())) {
    while (choices.next() && spend(1)) {
      std::string fact = text_of(head, binding);
      if (!facts_.contains(fact) && truth_of(rule.body, binding) == Truth::yes)
        facts_.insert(std::move(fact));
    }
  }
  deriving_ = nullptr;
  return given_up_at_.empty() && facts_.size() > before;
}

bool ClosedWorld::spend(std::size_t steps) {
  steps_ += steps;
  if (steps_ <= kMostSteps) return true;
  if (given_up_at_.empty())
    given_up_at_ = deriving_ == nullptr
                       ? "a quantifier of the goal"
                       : "derived predicate '" + deriving_->head.name + "' (" + domain_.file + ":" +
                             std::to_string(deriving_->head.where.line) + ":" +
                             std::to_string(deriving_->head.where.column) + ")";
  return false;
}

Truth ClosedWorld::truth_of(const pddl::Condition& condition) { return truth_of(condition, {}); }

Truth ClosedWorld::of_fact(const pddl::Atom& fact, const Binding& binding) {
  if (!derived_ && std::ranges::any_of(domain_.derived, [&](const pddl::DerivedPredicate& rule) {
        return rule.head.name == fact.symbol;
      }))
    derive();
  return given_up_at_.empty() ? of(facts_.contains(text_of(fact, binding))) : Truth::unknown;
}

Truth ClosedWorld::of_all(const std::vector<pddl::Condition>& parts, const Binding& binding) {
  Truth out = Truth::yes;
  for (const pddl::Condition& part : parts) {
    out = std::min(out, truth_of(part, binding));
    if (out == Truth::no) break;
  }
  return out;
}

Truth ClosedWorld::for_all(const std::vector<pddl::TypedName>& variables, const pddl::Condition& body,
                           const Binding& binding, bool negated) {
  Binding with = binding;
  Choices choices(objects_, variables, with);
  if (!spend(binding.size() + choices.candidates())) return Truth::unknown;
  Truth out = Truth::yes;
  while (out != Truth::no && choices.next()) {
    const Truth one = truth_of(body, with);
    if (!given_up_at_.empty()) return Truth::unknown;
    out = std::min(out, negated ? opposite(one) : one);
  }
  return out;
}

Truth ClosedWorld::truth_of(const pddl::Condition& condition, const Binding& binding) {
  if (!spend(1)) return Truth::unknown;
  return std::visit(
      pddl::Overloaded{
          [&](const pddl::Atom& fact) { return of_fact(fact, binding); },
          [&](const pddl::And& all) { return of_all(all.parts, binding); },
          [&](const pddl::Or& any) {
            Truth out = Truth::no;
            for (const pddl::Condition& part : any.parts) {
              out = std::max(out, truth_of(part, binding));
              if (out == Truth::yes) break;
            }
            return out;
          },
          [&](const pddl::Not& negated) { return opposite(truth_of(*negated.body, binding)); },
          [&](const pddl::Imply& imply) {
            return std::max(opposite(truth_of(*imply.premise, binding)),
                            truth_of(*imply.conclusion, binding));
          },
          [&](const pddl::Forall& all) { return for_all(all.variables, *all.body, binding, false); },
          [&](const pddl::Exists& some) {
            return opposite(for_all(some.variables, *some.body, binding, true));
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
