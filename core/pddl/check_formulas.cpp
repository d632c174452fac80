#include <algorithm>
#include <set>

#include "core/pddl/check_parts.hpp"
#include "core/pddl/overloaded.hpp"
#include "core/pddl/printer.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl {

namespace {

std::string join(const std::vector<std::string>& types) {
  std::string text;
  for (const std::string& type : types) text += (text.empty() ? "" : " or ") + type;
  return text;
}

// Names the predicate or function of an atom in messages.
std::string owner(const Atom& atom, std::string_view what) {
  return std::string(what) + " '" + atom.symbol + "'";
}

}  // namespace

void FormulaChecker::bind(const std::vector<TypedName>& variables) {
  check_variables(variables, symbols_, findings_);
  for (const TypedName& variable : variables) {
    if (variable.name == "?duration") {
      findings_.add(variable.where, "?duration as the name of a variable", "it is reserved: rename it");
    }
    if (is_bound(variable.name))
      findings_.add(variable.where, "variable '" + variable.name + "' hides an outer one", "rename it");
  }
  for (const TypedName& variable : variables) bound_.push_back(&variable);
}

void FormulaChecker::unbind(const std::vector<TypedName>& variables) {
  bound_.resize(bound_.size() - variables.size());
}

bool FormulaChecker::is_bound(std::string_view name) const { return find_variable(name) != nullptr; }

const TypedName* FormulaChecker::find_variable(std::string_view name) const {
  const auto outermost = std::ranges::find(bound_, name, &TypedName::name);
  return outermost == bound_.end() ? nullptr : *outermost;
}

std::string FormulaChecker::remedy_for_variable(const std::string& name) const {
  words::NearestWord near(name);
  std::set<std::string_view> names;
  for (const TypedName* bound : bound_) names.insert(bound->name);
  for (const std::string_view bound : names) near.offer(bound);
  return near.remedy("add it to :parameters or a quantifier");
}

// A variable must fit whichever object it takes; an object fits if one of its types does.
void FormulaChecker::check_argument(const Term& term, const TypedName& parameter, const Atom& atom,
                                    std::string_view what) {
  const TypeTree& types = symbols_.types();
  bool fits = false;
  const std::vector<std::string>* given = nullptr;
  if (term.is_variable()) {
    const TypedName* variable = find_variable(term.name);
    if (!variable) {
      findings_.add(term.where, "unbound variable '" + term.name + "'", remedy_for_variable(term.name));
      return;
    }
    given = &variable->types;
    fits = *given == parameter.types || types.accepts(parameter.types, *given);
  } else {
    given = symbols_.find_object_types(term.name);
    if (!given) {
      if (symbols_.unread().objects) return;
      const bool has_variable = is_bound("?" + term.name);
      findings_.add(term.where, "unknown object '" + term.name + "'",
                    has_variable
                        ? "did you mean the variable '?" + term.name + "'?"
                        : symbols_.remedy_for_object(term.name, "declare it in :objects or :constants"));
      return;
    }
    fits = *given == parameter.types || std::ranges::any_of(*given, [&](const std::string& type) {
      return types.is_any(type, parameter.types);
    });
  }
  if (fits || symbols_.unread().types) return;
  const auto known = [&](const std::string& type) { return types.knows(type); };
  if (!std::ranges::all_of(*given, known) || !std::ranges::all_of(parameter.types, known))
    return;  // told where it is declared
  findings_.add(term.where,
                "'" + term.name + "' is of type " + join(*given) + ", but " + owner(atom, what) + " takes " +
                    join(parameter.types) + " here",
                "use a term of that type");
}

void FormulaChecker::check_arguments(const Atom& atom, const Signature& signature, std::string_view what) {
  if (atom.arguments.size() != signature.parameters.size()) {
    findings_.add(atom.where,
                  owner(atom, what) + " has " + std::to_string(atom.arguments.size()) +
                      " arguments, declared with " + std::to_string(signature.parameters.size()),
                  "write it as " + signature.name + " is declared");
    return;
  }
  for (std::size_t i = 0; i < atom.arguments.size(); ++i) {
    check_argument(atom.arguments[i], signature.parameters[i], atom, what);
  }
}

void FormulaChecker::check_fact(const Atom& atom) {
  if (const Signature* signature = symbols_.find_predicate(atom.symbol)) {
    check_arguments(atom, *signature, "predicate");
  } else if (!symbols_.unread().predicates) {
    findings_.add(atom.where, "unknown predicate '" + atom.symbol + "'",
                  symbols_.remedy_for_predicate(atom.symbol, "declare it in :predicates"));
  }
}

void FormulaChecker::check_basic_fact(const Atom& atom) {
  check_fact(atom);
  if (symbols_.is_derived(atom.symbol)) {
    findings_.add(atom.where, "derived predicate '" + atom.symbol + "' is set directly",
                  "set what it is derived from");
  }
}

void FormulaChecker::check_fluent(const Atom& atom) {
  if (const Signature* signature = symbols_.find_fluent(atom.symbol)) {
    check_arguments(atom, *signature, "function");
  } else if (symbols_.find_external(atom.symbol)) {
    findings_.add(atom.where, "external function '" + atom.symbol + "' is set",
                  "its module alone gives its values");
  } else if (!symbols_.unread().functions) {
    findings_.add(atom.where, "unknown function '" + atom.symbol + "'",
                  symbols_.remedy_for_function(atom.symbol, "declare it in :functions"));
  }
}

void FormulaChecker::check_expression(const Expression& expression, ExpressionContext context) {
  const auto require = [&](bool allowed, std::string_view what, std::string_view remedy) {
    if (!allowed)
      findings_.add(expression.where, std::string(what) + " has no meaning here", std::string(remedy));
  };
  std::visit(
      Overloaded{[](const Number&) {},
                 [&](const Atom& atom) {
                   const Signature* signature = symbols_.find_fluent(atom.symbol);
                   if (!signature) signature = symbols_.find_external(atom.symbol);
                   if (signature) return check_arguments(atom, *signature, "function");
                   if (symbols_.unread().functions) return;
                   findings_.add(
                       atom.where, "unknown function '" + atom.symbol + "'",
                       symbols_.remedy_for_function(atom.symbol, "declare it in :functions or :modules"));
                 },
                 [&](const DurationVariable&) {
                   require(context.duration, "?duration", "it stands in effects of durative actions");
                 },
                 [&](const TotalTime&) { require(context.total_time, "total-time", "it stands in :metric"); },
                 [&](const ContinuousTime&) {
                   require(context.continuous_time, "#t", "it stands in continuous effects");
                 },
                 [&](const Arithmetic& arithmetic) {
                   for (const Expression& operand : arithmetic.operands) check_expression(operand, context);
                 }},
      expression.node);
}

void FormulaChecker::check_condition(const Condition& condition) {
  const auto check_all = [&](const std::vector<Condition>& parts) {
    for (const Condition& part : parts) check_condition(part);
  };
  const auto check_quantified = [&](const auto& quantified) {
    bind(quantified.variables);
    check_condition(*quantified.body);
    unbind(quantified.variables);
  };
  std::visit(
      Overloaded{[&](const And& all) { check_all(all.parts); }, [&](const Or& any) { check_all(any.parts); },
                 [&](const Not& negation) { check_condition(*negation.body); },
                 [&](const Imply& imply) {
                   check_condition(*imply.premise);
                   check_condition(*imply.conclusion);
                 },
                 [&](const Forall& forall) { check_quantified(forall); },
                 [&](const Exists& exists) { check_quantified(exists); },
                 [&](const Atom& atom) { check_fact(atom); },
                 [&](const TermEquality& equality) {
                   for (const Term* term : {&equality.left, &equality.right}) {
                     if (find_variable(term->name) || symbols_.find_object_types(term->name)) continue;
                     if (!term->is_variable() && symbols_.unread().objects) continue;
                     findings_.add(term->where, "unknown '" + term->name + "'",
                                   "bind the variable or declare the object; functions stand in parentheses");
                   }
                 },
                 [&](const Comparison& comparison) {
                   check_expression(comparison.left, {});
                   check_expression(comparison.right, {});
                 }},
      condition.node);
}

void FormulaChecker::check_timed(const TimedCondition& condition) {
  check_condition(condition.at_start);
  check_condition(condition.over_all);
  check_condition(condition.at_end);
}

void FormulaChecker::check_effects(const std::vector<Effect>& effects, ExpressionContext context) {
  for (const Effect& effect : effects) {
    std::visit(Overloaded{[&](const Literal& literal) { check_basic_fact(literal.atom); },
                          [&](const Assignment& assignment) {
                            check_fluent(assignment.fluent);
                            check_expression(assignment.value, context);
                          },
                          [&](const When& when) {
                            check_timed(when.condition);
                            check_effects(when.effects, context);
                          },
                          [&](const ForallEffect& forall) {
                            bind(forall.variables);
                            check_effects(forall.effects, context);
                            unbind(forall.variables);
                          }},
               effect.node);
  }
}

}  // namespace roci::pddl
