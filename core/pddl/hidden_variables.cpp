#include "core/pddl/hidden_variables.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/pddl/overloaded.hpp"

namespace roci::pddl {

namespace {

class Renamer {
 public:
  explicit Renamer(DiagnosticLog& log) : log_(log) {}

  // Calls walk() with the variables bound, under new names where they hide others.
  template <typename Walk>
  void bind(std::vector<TypedName>& variables, Walk walk) {
    std::map<std::string, std::string> outside;  // what each name stands for outside; empty: for nothing
    std::vector<std::string> called;
    for (TypedName& variable : variables) {
      const std::string name = variable.name;
      const auto outer = names_.find(name);
      const bool is_new = outside.emplace(name, outer == names_.end() ? "" : outer->second).second;
      if (!is_new) continue;  // one list has it twice: the checks tell that
      while (called_.contains(variable.name)) variable.name += "'";
      if (variable.name != name) {
        log_.warn(
            Departure::hidden_variable, variable.where,
            "variable '" + name + "' hides an outer one; inside of its quantifier the inner one is meant",
            "rename one of them");
      }
      names_[name] = variable.name;
      called_.insert(variable.name);
      called.push_back(variable.name);
    }
    walk();
    for (const std::string& name : called) called_.erase(name);
    for (auto& [name, before] : outside) {
      if (before.empty()) {
        names_.erase(name);
      } else {
        names_[name] = std::move(before);
      }
    }
  }

  void walk(Term& term) {
    if (const auto renamed = names_.find(term.name); renamed != names_.end()) term.name = renamed->second;
  }

  void walk(Atom& atom) {
    for (Term& term : atom.arguments) walk(term);
  }

  void walk(Expression& expression) {
    if (Atom* atom = std::get_if<Atom>(&expression.node)) walk(*atom);
    if (Arithmetic* sum = std::get_if<Arithmetic>(&expression.node))
      for (Expression& operand : sum->operands) walk(operand);
  }

  void walk(Condition& condition) {
    const auto all = [&](std::vector<Condition>& parts) {
      for (Condition& part : parts) walk(part);
    };
    std::visit(Overloaded{[&](And& parts) { all(parts.parts); }, [&](Or& parts) { all(parts.parts); },
                          [&](Not& negation) { walk(*negation.body); },
                          [&](Imply& imply) {
                            walk(*imply.premise);
                            walk(*imply.conclusion);
                          },
                          [&](Forall& forall) { bind(forall.variables, [&] { walk(*forall.body); }); },
                          [&](Exists& exists) { bind(exists.variables, [&] { walk(*exists.body); }); },
                          [&](Atom& atom) { walk(atom); },
                          [&](TermEquality& equality) {
                            walk(equality.left);
                            walk(equality.right);
                          },
                          [&](Comparison& comparison) {
                            walk(comparison.left);
                            walk(comparison.right);
                          }},
               condition.node);
  }

  void walk(TimedCondition& condition) {
    walk(condition.at_start);
    walk(condition.over_all);
    walk(condition.at_end);
  }

  void walk(std::vector<Effect>& effects) {
    for (Effect& effect : effects) {
      std::visit(
          Overloaded{[&](Literal& literal) { walk(literal.atom); },
                     [&](Assignment& assignment) {
                       walk(assignment.fluent);
                       walk(assignment.value);
                     },
                     [&](When& when) {
                       walk(when.condition);
                       walk(when.effects);
                     },
                     [&](ForallEffect& forall) { bind(forall.variables, [&] { walk(forall.effects); }); }},
          effect.node);
    }
  }

 private:
  DiagnosticLog& log_;
  std::map<std::string, std::string>
      names_;  // of the variables bound so far, as written and as they are called
  std::set<std::string> called_;
};

}  // namespace

void rename_hiding_variables(Domain& domain, DiagnosticLog& log) {
  Renamer renamer(log);
  for (DerivedPredicate& derived : domain.derived)
    renamer.bind(derived.head.parameters, [&] { renamer.walk(derived.body); });
  for (Action& action : domain.actions) {
    renamer.bind(action.parameters, [&] {
      renamer.walk(action.precondition);
      renamer.walk(action.effects);
    });
  }
  for (DurativeAction& action : domain.durative_actions) {
    renamer.bind(action.parameters, [&] {
      for (DurationConstraint& constraint : action.duration) renamer.walk(constraint.bound);
      renamer.walk(action.condition);
      renamer.walk(action.start_effects);
      renamer.walk(action.end_effects);
      renamer.walk(action.continuous_effects);
    });
  }
}

void rename_hiding_variables(Problem& problem, DiagnosticLog& log) { Renamer(log).walk(problem.goal); }

}  // namespace roci::pddl
