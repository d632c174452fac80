#include "planner_svc/temporal_pddl/extraction/ground_text.hpp"

#include <algorithm>
#include <utility>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"

namespace roci::planner::temporal_pddl::extraction {

using grounding::lifted::combine;
using task::FunctionId;
using task::ObjectId;

namespace {

const char* keyword(pddl::AssignmentOperator op) {
  switch (op) {
    case pddl::AssignmentOperator::assign:
      return "assign";
    case pddl::AssignmentOperator::increase:
      return "increase";
    case pddl::AssignmentOperator::decrease:
      return "decrease";
    case pddl::AssignmentOperator::scale_up:
      return "scale-up";
    case pddl::AssignmentOperator::scale_down:
      return "scale-down";
  }
  return "assign";
}

}  // namespace

std::vector<GroundCondition> GroundText::conditions(const pddl::Condition& condition) const {
  std::vector<GroundCondition> result;
  add_conditions(condition, result);
  return result;
}

std::vector<GroundEffect> GroundText::effects(const std::vector<pddl::Effect>& effects) const {
  std::vector<std::string> texts;
  for (const auto& effect : effects) add_effect(effect, texts);
  std::vector<GroundEffect> result;
  for (auto& text : texts) result.push_back({std::move(text)});
  return result;
}

void GroundText::add_conditions(const pddl::Condition& condition,
                                std::vector<GroundCondition>& result) const {
  if (const auto* conjunction = std::get_if<pddl::And>(&condition.node)) {
    for (const auto& part : conjunction->parts) add_conditions(part, result);
    return;
  }
  auto kind = GroundCondition::Kind::formula;
  const pddl::Condition* shown = &condition;
  if (std::holds_alternative<pddl::Atom>(condition.node)) kind = GroundCondition::Kind::fact;
  if (std::holds_alternative<pddl::Comparison>(condition.node)) kind = GroundCondition::Kind::comparison;
  if (const auto* negation = std::get_if<pddl::Not>(&condition.node)) {
    if (std::holds_alternative<pddl::Atom>(negation->body->node)) {
      kind = GroundCondition::Kind::negated_fact;
      shown = &*negation->body;
    }
  }
  result.push_back({kind, pddl::print(ground(*shown))});
}

void GroundText::add_effect(const pddl::Effect& effect, std::vector<std::string>& result) const {
  std::visit(pddl::Overloaded{
                 [&](const pddl::Literal& literal) {
                   result.push_back(pddl::print(pddl::Literal{ground(literal.atom), literal.negated}));
                 },
                 [&](const pddl::Assignment& assignment) {
                   result.push_back(std::string("(") + keyword(assignment.op) + " " +
                                    pddl::print(ground(assignment.fluent)) + " " +
                                    pddl::print(ground(assignment.value)) + ")");
                 },
                 [&](const pddl::When& when) {
                   std::vector<std::string> inner;
                   for (const auto& part : when.effects) add_effect(part, inner);
                   std::string condition;
                   for (const auto* part :
                        {&when.condition.at_start, &when.condition.over_all, &when.condition.at_end}) {
                     for (const auto& c : conditions(*part)) {
                       const bool negated = c.kind == GroundCondition::Kind::negated_fact;
                       condition += " " + (negated ? "(not " + c.text + ")" : c.text);
                     }
                   }
                   for (const auto& text : inner)
                     result.push_back("(when (and" + condition + ") " + text + ")");
                 },
                 [&](const pddl::ForallEffect& forall) {
                   std::vector<GroundText> instances{*this};
                   for (const auto& variable : forall.variables) {
                     std::vector<GroundText> longer;
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

pddl::Term GroundText::ground(const pddl::Term& term) const {
  const auto found = variables_.find(term.name);
  return found == variables_.end() ? term : pddl::Term{found->second, term.where};
}

pddl::Atom GroundText::ground(const pddl::Atom& atom) const {
  pddl::Atom result = atom;
  for (auto& term : result.arguments) term = ground(term);
  return result;
}

// Constants become numbers, and so do expressions of numbers alone.
pddl::Expression GroundText::ground(const pddl::Expression& expression) const {
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

pddl::Condition GroundText::ground(const pddl::Condition& condition) const {
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
GroundText GroundText::without(const std::vector<pddl::TypedName>& variables) const {
  auto kept = variables_;
  for (const auto& variable : variables) kept.erase(variable.name);
  return {symbols_, constants_, std::move(kept)};
}

}  // namespace roci::planner::temporal_pddl::extraction
