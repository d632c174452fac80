#include "core/pddl/forbidden.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

// Calls visit(assignment, where) for each numeric effect, inside `when` and `forall` too.
template <typename Visit>
void for_each_assignment(const std::vector<Effect>& effects, const Visit& visit) {
  for (const Effect& effect : effects) {
    std::visit(Overloaded{[](const Literal&) {},
                          [&](const Assignment& assignment) { visit(assignment, effect.where); },
                          [&](const When& when) { for_each_assignment(when.effects, visit); },
                          [&](const ForallEffect& forall) { for_each_assignment(forall.effects, visit); }},
               effect.node);
  }
}

std::set<std::string> changing_fluents(const Domain& domain, const Problem& problem) {
  std::set<std::string> changing;
  const auto note = [&](const Assignment& assignment, SourceLocation) {
    changing.insert(assignment.fluent.symbol);
  };
  for (const Action& action : domain.actions) for_each_assignment(action.effects, note);
  for (const DurativeAction& action : domain.durative_actions) {
    for_each_assignment(action.start_effects, note);
    for_each_assignment(action.end_effects, note);
    for_each_assignment(action.continuous_effects, note);
  }
  for (const TimedValue& timed : problem.timed_values) changing.insert(timed.fluent.symbol);
  return changing;
}

// Returns the degree in the fluents that change: 0 for constant, 1 for linear, 2 for neither.
int degree(const Expression& expression, const std::set<std::string>& changing) {
  const Arithmetic* arithmetic = std::get_if<Arithmetic>(&expression.node);
  if (!arithmetic) {
    const Atom* atom = std::get_if<Atom>(&expression.node);
    return atom && changing.contains(atom->symbol) ? 1 : 0;
  }
  int highest = 0;
  int sum = 0;
  int last = 0;  // of the operand that divides
  for (const Expression& operand : arithmetic->operands) {
    last = degree(operand, changing);
    highest = std::max(highest, last);
    sum += last;
  }
  if (arithmetic->op == ArithmeticOperator::multiply) return std::min(sum, 2);
  if (arithmetic->op == ArithmeticOperator::divide && last > 0) return 2;
  return highest;
}

bool is_linear(const Assignment& assignment, const std::set<std::string>& changing) {
  const int of_value = degree(assignment.value, changing);
  const bool scales =
      assignment.op == AssignmentOperator::scale_up || assignment.op == AssignmentOperator::scale_down;
  return of_value + (scales ? 1 : 0) <= 1;
}

bool mentions_duration(const Expression& expression) {
  if (const Arithmetic* arithmetic = std::get_if<Arithmetic>(&expression.node)) {
    return std::any_of(arithmetic->operands.begin(), arithmetic->operands.end(), mentions_duration);
  }
  return std::holds_alternative<DurationVariable>(expression.node);
}

bool fixes_duration(const DurativeAction& action) {
  return std::any_of(action.duration.begin(), action.duration.end(),
                     [](const DurationConstraint& constraint) {
                       return constraint.op == ComparisonOperator::equal && constraint.at == TimePoint::start;
                     });
}

}  // namespace

std::vector<Diagnostic> forbidden_effects(const Domain& domain, const Problem& problem) {
  const std::set<std::string> changing = changing_fluents(domain, problem);
  std::vector<Diagnostic> found;
  const auto report = [&](const std::string& action, const Assignment& assignment, SourceLocation where,
                          const std::string& what, const std::string& remedy) {
    found.push_back({domain.file, where,
                     "action '" + action + "' has a " + what + " effect on " + print(assignment.fluent),
                     remedy, Severity::unsupported});
  };
  const auto check_linear = [&](const std::string& action, const Assignment& assignment,
                                SourceLocation where) {
    if (is_linear(assignment, changing)) return;
    report(action, assignment, where, "non-linear", "multiply and divide by constants only");
  };
  for (const Action& action : domain.actions) {
    for_each_assignment(action.effects, [&](const Assignment& assignment, SourceLocation where) {
      check_linear(action.name, assignment, where);
    });
  }
  for (const DurativeAction& action : domain.durative_actions) {
    const bool fixed = fixes_duration(action);
    const auto check_discrete = [&](const Assignment& assignment, SourceLocation where) {
      check_linear(action.name, assignment, where);
      if (fixed || !mentions_duration(assignment.value)) return;
      report(action.name, assignment, where, "duration-dependent", "fix the duration with (= ?duration …)");
    };
    for_each_assignment(action.start_effects, check_discrete);
    for_each_assignment(action.end_effects, check_discrete);
    for_each_assignment(action.continuous_effects, [&](const Assignment& assignment, SourceLocation where) {
      report(action.name, assignment, where, "continuous", "use a discrete effect at start or at end");
    });
  }
  return found;
}

}  // namespace roci::pddl
