#include "exec_svc/mission/goal_formula.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/parser.hpp"
#include "core/pddl/printer.hpp"

namespace roci::exec::mission {
namespace {

using temporal::ConditionOp;
using Translated = std::optional<temporal::Condition>;

Translated translated(const pddl::Condition& formula);

// Translates all parts, or returns nothing if one has no translation.
std::optional<std::vector<temporal::Condition>> translated(const std::vector<pddl::Condition>& parts) {
  std::vector<temporal::Condition> out;
  for (const pddl::Condition& part : parts) {
    Translated one = translated(part);
    if (!one) return std::nullopt;
    out.push_back(std::move(*one));
  }
  return out;
}

ConditionOp operator_of(pddl::ComparisonOperator op, bool turned) {
  switch (op) {
    case pddl::ComparisonOperator::less:
      return turned ? ConditionOp::gt : ConditionOp::lt;
    case pddl::ComparisonOperator::less_equal:
      return turned ? ConditionOp::ge : ConditionOp::le;
    case pddl::ComparisonOperator::greater_equal:
      return turned ? ConditionOp::le : ConditionOp::ge;
    case pddl::ComparisonOperator::greater:
      return turned ? ConditionOp::lt : ConditionOp::gt;
    case pddl::ComparisonOperator::equal:
      break;
  }
  return ConditionOp::eq;
}

Translated translated(const pddl::Comparison& comparison) {
  const auto* left = std::get_if<pddl::Atom>(&comparison.left.node);
  const auto* right = std::get_if<pddl::Atom>(&comparison.right.node);
  const auto* number =
      std::get_if<pddl::Number>(left != nullptr ? &comparison.right.node : &comparison.left.node);
  const pddl::Atom* fluent = left != nullptr ? left : right;
  if (fluent == nullptr || number == nullptr) return std::nullopt;
  return temporal::compare(pddl::print(*fluent), operator_of(comparison.op, left == nullptr), number->value);
}

Translated translated(const pddl::Condition& formula) {
  return std::visit(pddl::Overloaded{
                        [](const pddl::Atom& fact) -> Translated {
                          return temporal::compare(pddl::print(fact), ConditionOp::eq, true);
                        },
                        [](const pddl::And& all) -> Translated {
                          const auto parts = translated(all.parts);
                          if (!parts) return std::nullopt;
                          return parts->size() == 1 ? parts->front() : temporal::all_of(*parts);
                        },
                        [](const pddl::Or& any) -> Translated {
                          const auto parts = translated(any.parts);
                          return parts ? Translated(temporal::any_of(*parts)) : std::nullopt;
                        },
                        [](const pddl::Not& negated) -> Translated {
                          if (const auto* fact = std::get_if<pddl::Atom>(&negated.body->node))
                            return temporal::compare(pddl::print(*fact), ConditionOp::eq, false);
                          const Translated body = translated(*negated.body);
                          return body ? Translated(temporal::negate(*body)) : std::nullopt;
                        },
                        [](const pddl::Imply& imply) -> Translated {
                          const Translated premise = translated(*imply.premise);
                          const Translated conclusion = translated(*imply.conclusion);
                          if (!premise || !conclusion) return std::nullopt;
                          return temporal::any_of({temporal::negate(*premise), *conclusion});
                        },
                        [](const pddl::Comparison& comparison) { return translated(comparison); },
                        [](const pddl::Forall&) -> Translated { return std::nullopt; },
                        [](const pddl::Exists&) -> Translated { return std::nullopt; },
                        [](const pddl::TermEquality&) -> Translated { return std::nullopt; },
                    },
                    formula.node);
}

}  // namespace

pddl::Condition read_goal_formula(const std::string& text) {
  // Reading is strict, as a text that closes more than it opens would end the problem and lose what follows.
  return pddl::parse_problem("(define (problem p) (:domain d) (:init) (:goal " + text + "))", "goal",
                             pddl::Strictness::strict)
      .goal;
}

bool is_observed_fact(const pddl::Condition& formula, const pddl::Domain& domain) {
  const auto* fact = std::get_if<pddl::Atom>(&formula.node);
  return fact != nullptr && std::ranges::none_of(domain.derived, [&](const pddl::DerivedPredicate& rule) {
           return rule.head.name == fact->symbol;
         });
}

temporal::Condition over_timelines(const pddl::Condition& formula) {
  return translated(formula).value_or(temporal::Condition{});
}

}  // namespace roci::exec::mission
