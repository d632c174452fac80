#include "core/pddl/check.hpp"
#include "core/pddl/check_parts.hpp"
#include "core/pddl/printer.hpp"
#include "core/pddl/settle.hpp"
#include "core/pddl/state_levels.hpp"

namespace roci::pddl {

namespace {

void check_init(const Problem& problem, FormulaChecker& formulas, Findings& findings) {
  for (const Atom& fact : problem.facts) formulas.check_basic_fact(fact);
  std::set<std::string> facts;  // only if there is something to compare them with
  if (!problem.false_facts.empty())
    for (const Atom& fact : problem.facts) facts.insert(print(fact));
  for (const Atom& fact : problem.false_facts) {
    formulas.check_basic_fact(fact);
    if (facts.contains(print(fact))) {
      findings.add(fact.where, print(fact) + " is both true and false in :init", "keep one");
    }
  }
  for (const InitialValue& initial : problem.values) formulas.check_fluent(initial.fluent);
  for (const TimedLiteral& timed : problem.timed_literals) formulas.check_basic_fact(timed.literal.atom);
  for (const TimedValue& timed : problem.timed_values) formulas.check_fluent(timed.fluent);
}

}  // namespace

std::vector<Diagnostic> check(const Problem& problem, const Domain& domain, const Unread& unread) {
  if (auto findings = check_state_dependence(problem, domain); !findings.empty()) return findings;
  Findings findings(problem.file);
  if (problem.domain_name != domain.name) {
    findings.add(problem.where,
                 "the problem is for domain '" + problem.domain_name + "', not '" + domain.name + "'",
                 "use the domain file that it was written for");
  }
  Symbols symbols(domain, unread);
  symbols.add_objects(problem.objects);
  check_types(problem.objects, symbols, findings);
  FormulaChecker formulas(symbols, findings);
  check_init(problem, formulas, findings);
  formulas.check_condition(problem.goal);
  if (problem.metric) formulas.check_expression(problem.metric->expression, {.total_time = true});
  return findings.take();
}

std::vector<Diagnostic> check(const Problem& problem, const Domain& domain) {
  return check(problem, domain, Unread{});
}

Problem load_problem(std::string_view text, std::string_view file, const Domain& domain,
                     Strictness strictness) {
  DiagnosticLog log{std::string(file), strictness};
  Unread unread;
  Problem problem = read_problem(text, log, unread);
  settle(problem, domain, log);
  for (Diagnostic& finding : check(problem, domain, unread)) log.add(std::move(finding));
  log.throw_errors();
  problem.warnings = log.warnings();
  return problem;
}

}  // namespace roci::pddl
