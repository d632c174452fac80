#include "tests/fuzz/pddl/target.hpp"

#include <stdexcept>

#include "core/pddl/check.hpp"
#include "core/pddl/forbidden.hpp"
#include "core/pddl/parser.hpp"
#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::fuzz {

namespace validate = planner::temporal_pddl::validate;

namespace {

// A domain and problem that use most of the language; the plans under test run in it.
constexpr std::string_view kDomain =
    "(define (domain d) (:types a b - t) (:predicates (p) (q ?x - t) (r ?x ?y - t) (s ?x - t)) (:functions "
    "(f) (g ?x - t))"
    "(:modules (:module m (:function (cost ?x ?y - t))))"
    "(:derived (s ?x - t) (or (q ?x) (exists (?y - t) (and (r ?x ?y) (s ?y)))))"
    "(:action act :parameters (?x - a) :precondition (forall (?y - t) (imply (q ?y) (not (= ?x ?y))))"
    " :effect (forall (?y - t) (when (s ?y) (and (r ?x ?y) (increase (g ?y) 1)))))"
    "(:durative-action move :parameters (?x ?y - t) :duration (= ?duration (cost ?x ?y))"
    " :condition (and (at start (s ?x)) (over all (>= (f) 0)) (at end (p)))"
    " :effect (and (at start (not (q ?x))) (at end (q ?y)) (at end (decrease (f) ?duration))"
    " (when (over all (p)) (at end (not (p)))))))";
constexpr std::string_view kProblem =
    "(define (problem p) (:domain d) (:objects a1 a2 - a b1 - b) (:init (p) (q a1) (r a2 a1) (= (f) 3) (= (g "
    "a1) 0)"
    " (at 2 (not (p))) (at 4 (p)) (at 5 (= (f) 9))) (:goal (and (q b1) (exists (?x - a) (s ?x))))"
    " (:metric minimize (total-time)))";
constexpr std::string_view kFunctions = "(cost a1 b1) 2\n(cost a2 b1) 0.5\n(cost b1 a1) unreachable\n";

template <typename Run>
void unless_refused(Run run) {
  try {
    run();
  } catch (const pddl::ParseError&) {
  }
}

void demand(bool fact, const char* what) {
  if (!fact) throw std::logic_error(what);
}

void run_domain(std::string_view text) {
  const pddl::Domain domain = pddl::parse_domain(text, "fuzz");
  demand(pddl::parse_domain(pddl::print(domain), "printed") == domain, "a printed domain differs");
  if (!pddl::check(domain).empty()) return;
  pddl::Problem problem;
  problem.domain_name = domain.name;
  if (!pddl::forbidden_effects(domain, problem).empty()) return;
  validate::validate(domain, problem, pddl::parse_plan("1: (a)\n2: (b c) [3]", "plan"), {});
}

void run_problem(std::string_view text) {
  const pddl::Problem problem = pddl::parse_problem(text, "fuzz");
  demand(pddl::parse_problem(pddl::print(problem), "printed") == problem, "a printed problem differs");
  const pddl::Domain domain = pddl::load_domain(kDomain, "domain");
  if (!pddl::check(problem, domain).empty()) return;
  validate::validate(domain, problem, pddl::parse_plan("1: (move a1 b1) [2]\n3: (act a1)", "plan"), {});
}

void run_plan(std::string_view text) {
  const auto plan = pddl::parse_plan(text, "fuzz");
  demand(pddl::parse_plan(pddl::print_plan(plan), "printed").size() == plan.size(), "a printed plan differs");
  const pddl::Domain domain = pddl::load_domain(kDomain, "domain");
  const pddl::Problem problem = pddl::load_problem(kProblem, "problem", domain);
  const auto functions = pddl::parse_function_table(kFunctions, "functions");
  const validate::Report report = validate::validate(domain, problem, plan, functions);
  demand(report.valid == report.violations.empty(), "a report contradicts itself");
}

}  // namespace

void run_all(std::string_view text) {
  unless_refused([&] { run_domain(text); });
  unless_refused([&] { run_problem(text); });
  unless_refused([&] { run_plan(text); });
  unless_refused([&] { pddl::parse_function_table(text, "fuzz"); });
}

}  // namespace roci::fuzz
