#include "core/pddl/check.hpp"
#include "core/pddl/check_parts.hpp"
#include "core/pddl/parser.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

void check_init(const Problem& problem, FormulaChecker& formulas, Findings& findings) {
  std::set<std::string> facts;
  for (const Atom& fact : problem.facts) {
    formulas.check_basic_fact(fact);
    facts.insert(print(fact));
  }
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

std::vector<Diagnostic> check(const Problem& problem, const Domain& domain) {
  Findings findings(problem.file);
  if (problem.domain_name != domain.name) {
    findings.add(problem.where,
                 "the problem is for domain '" + problem.domain_name + "', not '" + domain.name + "'",
                 "use the domain file that it was written for");
  }
  Symbols symbols(domain);
  check_types(problem.objects, symbols, findings);
  symbols.add_objects(problem.objects);
  FormulaChecker formulas(symbols, findings);
  check_init(problem, formulas, findings);
  formulas.check_condition(problem.goal);
  if (problem.metric) formulas.check_expression(problem.metric->expression, {.total_time = true});
  return findings.take();
}

Problem load_problem(std::string_view text, std::string_view file, const Domain& domain) {
  Problem problem = parse_problem(text, file);
  if (auto findings = check(problem, domain); !findings.empty())
    throw ParseError(std::move(findings.front()));
  return problem;
}

}  // namespace roci::pddl
