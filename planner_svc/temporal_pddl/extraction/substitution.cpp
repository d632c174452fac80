#include "planner_svc/temporal_pddl/extraction/substitution.hpp"

#include <algorithm>
#include <utility>

#include "core/pddl/overloaded.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"

namespace roci::planner::temporal_pddl::extraction {

using grounding::lifted::combine;
using task::FunctionId;
using task::ObjectId;

std::vector<pddl::Condition> Substitution::conditions(const pddl::Condition& condition) const {
  std::vector<pddl::Condition> result;
  add_conditions(condition, result);
  return result;
}

std::vector<pddl::Effect> Substitution::effects(const std::vector<pddl::Effect>& effects) const {
  std::vector<pddl::Effect> result;
  for (const auto& effect : effects) add_effect(effect, result);
  return result;
}

void Substitution::add_conditions(const pddl::Condition& condition,
                                  std::vector<pddl::Condition>& result) const {
  if (const auto* conjunction = std::get_if<pddl::And>(&condition.node)) {
    for (const auto& part : conjunction->parts) add_conditions(part, result);
  } else {
    result.push_back(ground(condition));
  }
}

void Substitution::add_effect(const pddl::Effect& effect, std::vector<pddl::Effect>& result) const {
  std::visit(pddl::Overloaded{
                 [&](const pddl::Literal& literal) {
                   result.push_back({pddl::Literal{ground(literal.atom), literal.negated}, effect.where});
                 },
                 [&](const pddl::Assignment& assignment) {
                   result.push_back(
                       {pddl::Assignment{assignment.op, ground(assignment.fluent), ground(assignment.value)},
                        effect.where});
                 },
                 [&](const pddl::When& when) {
                   const pddl::TimedCondition condition{ground(when.condition.at_start),
                                                        ground(when.condition.over_all),
                                                        ground(when.condition.at_end)};
                   std::vector<pddl::Effect> inner;
                   for (const auto& part : when.effects) add_effect(part, inner);
                   for (auto& part : inner)
                     result.push_back({pddl::When{condition, {std::move(part)}}, effect.where});
                 },
                 [&](const pddl::ForallEffect& forall) {
                   std::vector<Substitution> instances{*this};
                   for (const auto& variable : forall.variables) {
                     std::vector<Substitution> longer;
                     for (const auto& instance : instances) {
                       for (const ObjectId object : symbols_.of_types(variable.types)) {
                         auto variables = instance.variables_;
                         variables[variable.name] = symbols_.name(object);
                         longer.emplace_back(symbols_, constants_, std::move(variables));
                       }
                     }
                     instances = std::move(longer);
                   }
                   for (const auto& instance : instances) {
                     for (const auto& part : forall.effects) instance.add_effect(part, result);
                   }
                 },
             },
             effect.node);
}

pddl::Term Substitution::ground(const pddl::Term& term) const {
  const auto found = variables_.find(term.name);
  return found == variables_.end() ? term : pddl::Term{found->second, term.where};
}

pddl::Atom Substitution::ground(const pddl::Atom& atom) const {
  pddl::Atom result = atom;
  for (auto& term : result.arguments) term = ground(term);
  return result;
}

// Constants become numbers, and so do expressions of numbers alone.
pddl::Expression Substitution::ground(const pddl::Expression& expression) const {
  pddl::Expression result = expression;
  if (auto* atom = std::get_if<pddl::Atom>(&result.node)) {
    *atom = ground(*atom);
    const FunctionId function = symbols_.function(atom->symbol);
    const bool variable_left = std::ranges::any_of(atom->arguments, &pddl::Term::is_variable);
    if (!constants_.is_constant(function) || variable_left) return result;
    std::vector<ObjectId> objects;
    for (const auto& term : atom->arguments) objects.push_back(symbols_.object(term.name));
    if (const auto value = constants_.value(function, objects)) result.node = pddl::Number{*value};
  } else if (auto* arithmetic = std::get_if<pddl::Arithmetic>(&result.node)) {
    std::vector<double> values;
    for (auto& operand : arithmetic->operands) {
      operand = ground(operand);
      if (const auto* number = std::get_if<pddl::Number>(&operand.node)) values.push_back(number->value);
    }
    if (values.size() == arithmetic->operands.size())
      result.node = pddl::Number{combine(arithmetic->op, values)};
  }
  return result;
}

pddl::Condition Substitution::ground(const pddl::Condition& condition) const {
  pddl::Condition result = condition;
  std::visit(pddl::Overloaded{
                 [&](pddl::And& a) {
                   for (auto& part : a.parts) part = ground(part);
                 },
                 [&](pddl::Or& o) {
                   for (auto& part : o.parts) part = ground(part);
                 },
                 [&](pddl::Not& n) { *n.body = ground(*n.body); },
                 [&](pddl::Imply& i) {
                   *i.premise = ground(*i.premise);
                   *i.conclusion = ground(*i.conclusion);
                 },
                 [&](pddl::Forall& f) { *f.body = without(f.variables).ground(*f.body); },
                 [&](pddl::Exists& e) { *e.body = without(e.variables).ground(*e.body); },
                 [&](pddl::Atom& atom) { atom = ground(atom); },
                 [&](pddl::TermEquality& e) {
                   e.left = ground(e.left);
                   e.right = ground(e.right);
                 },
                 [&](pddl::Comparison& c) {
                   c.left = ground(c.left);
                   c.right = ground(c.right);
                 },
             },
             result.node);
  return result;
}

// Quantified variables hide parameters of the same name.
Substitution Substitution::without(const std::vector<pddl::TypedName>& variables) const {
  auto kept = variables_;
  for (const auto& variable : variables) kept.erase(variable.name);
  return {symbols_, constants_, std::move(kept)};
}

}  // namespace roci::planner::temporal_pddl::extraction
