#include "exec_svc/mission/variable_count.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/pddl/overloaded.hpp"

namespace roci::exec::mission {
namespace {

std::size_t count(const std::vector<pddl::Condition>& parts) {
  std::size_t out = 0;
  for (const pddl::Condition& part : parts) out += variable_count(part);
  return out;
}

std::size_t count(const pddl::TimedCondition& condition) {
  return variable_count(condition.at_start) + variable_count(condition.over_all) +
         variable_count(condition.at_end);
}

std::size_t count(const std::vector<pddl::Effect>& effects) {
  std::size_t out = 0;
  for (const pddl::Effect& effect : effects)
    out += std::visit(
        pddl::Overloaded{
            [](const pddl::When& when) { return count(when.condition) + count(when.effects); },
            [](const pddl::ForallEffect& all) { return all.variables.size() + count(all.effects); },
            [](const auto&) { return std::size_t{0}; },
        },
        effect.node);
  return out;
}

}  // namespace

std::size_t variable_count(const pddl::Condition& condition) {
  return std::visit(
      pddl::Overloaded{
          [](const pddl::And& all) { return count(all.parts); },
          [](const pddl::Or& any) { return count(any.parts); },
          [](const pddl::Not& negated) { return variable_count(*negated.body); },
          [](const pddl::Imply& imply) {
            return variable_count(*imply.premise) + variable_count(*imply.conclusion);
          },
          [](const pddl::Forall& all) { return all.variables.size() + variable_count(*all.body); },
          [](const pddl::Exists& some) { return some.variables.size() + variable_count(*some.body); },
          [](const auto&) { return std::size_t{0}; },
      },
      condition.node);
}

void require_few_variables(const pddl::Domain& domain) {
  std::vector<pddl::Diagnostic> found;
  const auto look_at = [&](const std::string& what, const pddl::SourceLocation& where,
                           std::size_t variables) {
    if (variables > kMostVariables)
      found.push_back({domain.file, where,
                       what + " has " + std::to_string(variables) + " variables, and " +
                           std::to_string(kMostVariables) + " are supported",
                       "use fewer parameters and quantifiers"});
  };
  for (const pddl::Action& action : domain.actions)
    look_at("action '" + action.name + "'", action.where,
            action.parameters.size() + variable_count(action.precondition) + count(action.effects));
  for (const pddl::DurativeAction& action : domain.durative_actions)
    look_at("action '" + action.name + "'", action.where,
            action.parameters.size() + count(action.condition) + count(action.start_effects) +
                count(action.end_effects));
  for (const pddl::DerivedPredicate& derived : domain.derived)
    look_at("derived predicate '" + derived.head.name + "'", derived.head.where,
            derived.head.parameters.size() + variable_count(derived.body));
  if (!found.empty()) throw pddl::ParseError(std::move(found));
}

}  // namespace roci::exec::mission
