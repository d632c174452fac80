#include "core/pddl/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

using ::testing::HasSubstr;

std::string findings_of(const std::vector<Diagnostic>& findings) {
  std::string text;
  for (const Diagnostic& finding : findings) {
    EXPECT_FALSE(finding.remedy.empty()) << finding.message;
    EXPECT_GT(finding.where.line, 0) << finding.message;
    text += to_string(finding) + "\n";
  }
  return text;
}

std::string check_section(const std::string& section) { return findings_of(check(domain_with(section))); }

std::string check_precondition(const std::string& condition) {
  return check_section("(:action a :parameters (?t - thing ?h - tool ?l - place) :precondition " + condition +
                       ")");
}

std::string check_problem(const std::string& init, const std::string& goal = "(p)") {
  return findings_of(check(problem_with(init, goal), domain_with("(:derived (s ?x - thing) (q ?x))")));
}

TEST(Check, AcceptsWhatIsRight) {
  EXPECT_EQ(check_section("(:derived (s ?x - thing) (or (q ?x) (exists (?y - place) (r ?x ?y))))"
                          "(:durative-action a :parameters (?t - tool ?l - place)"
                          " :duration (and (>= ?duration (cost ?t ?l)) (<= ?duration (f)))"
                          " :condition (and (at start (r ?t base)) (over all (>= (g ?t) (cost hammer ?l))))"
                          " :effect (and (at start (not (q ?t))) (at end (increase (f) (* 2 ?duration)))"
                          " (forall (?x - thing) (when (at start (s ?x)) (at end (q ?x))))))"),
            "");
  EXPECT_EQ(
      check_problem(
          "(p) (q nail) (q hammer) (r nail pit) (r hammer base) (= (f) 3) (at 5 (not (p))) (at 5 (= (f) 2))",
          "(and (s nail) (forall (?x - tool) (q ?x)))"),
      "");
}

TEST(Check, FindsUnknownNames) {
  EXPECT_THAT(check_section("(:predicates (z ?x - gadget))"),
              HasSubstr("d.pddl:7:17: error: unknown type 'gadget'"));
  EXPECT_THAT(check_section("(:constants c - gadget)"), HasSubstr("unknown type 'gadget'"));
  EXPECT_THAT(check_section("(:functions (z ?x - gadget))"), HasSubstr("unknown type 'gadget'"));
  EXPECT_THAT(check_precondition("(zap)"), HasSubstr("unknown predicate 'zap'"));
  EXPECT_THAT(check_precondition("(q ?x)"), HasSubstr("unbound variable '?x'"));
  EXPECT_THAT(check_precondition("(q saw)"), HasSubstr("unknown object 'saw'"));
  EXPECT_THAT(check_precondition("(= ?t saw)"), HasSubstr("unknown 'saw'"));
  EXPECT_THAT(check_precondition("(< (h) 1)"), HasSubstr("unknown function 'h'"));
  EXPECT_THAT(check_precondition("(and (exists (?x - thing) (q ?x)) (q ?x))"),
              HasSubstr("unbound variable '?x'"));
}

TEST(Check, FindsWrongArguments) {
  EXPECT_THAT(check_precondition("(q ?t ?l)"), HasSubstr("has 2 arguments, declared with 1"));
  EXPECT_THAT(check_precondition("(q ?l)"), HasSubstr("'?l' is of type place"));
  EXPECT_THAT(check_precondition("(r ?t hammer)"), HasSubstr("'hammer' is of type tool"));
  EXPECT_EQ(check_precondition("(and (q ?h) (q hammer))"), "") << "subtypes fit";
  EXPECT_THAT(check_precondition("(exists (?x - (either tool place)) (q ?x))"), HasSubstr("tool or place"));
  EXPECT_THAT(check_precondition("(< (g) 1)"), HasSubstr("function 'g' has 0 arguments"));
  EXPECT_THAT(check_precondition("(< (cost ?l ?t) 1)"), HasSubstr("function 'cost' takes thing"));
}

TEST(Check, FindsDoubleDeclarations) {
  EXPECT_THAT(check_section("(:predicates (p))"), HasSubstr("predicate 'p' is declared twice"));
  EXPECT_THAT(check_section("(:functions (cost))"), HasSubstr("function 'cost' is declared twice"));
  EXPECT_THAT(check_section("(:modules (:module m))"), HasSubstr("module 'm' is declared twice"));
  EXPECT_THAT(check_section("(:action a) (:durative-action a :duration ())"),
              HasSubstr("action 'a' is declared twice"));
  EXPECT_THAT(check_section("(:action a :parameters (?x ?x))"), HasSubstr("variable '?x' is declared twice"));
  EXPECT_THAT(check_precondition("(forall (?t - tool) (q ?t))"), HasSubstr("hides an outer one"));
  EXPECT_EQ(check_section("(:types tool - place)"), "") << "a second supertype, as IPC storage has it";
}

TEST(Check, FindsCircularTypes) {
  EXPECT_THAT(check_section("(:types x - y y - z z - x)"), HasSubstr("type 'x' is above itself"));
}

TEST(Check, ReservesSpecialNumbers) {
  EXPECT_THAT(check_precondition("(< ?duration 3)"), HasSubstr("?duration has no meaning here"));
  EXPECT_THAT(check_precondition("(< total-time 3)"), HasSubstr("total-time has no meaning here"));
  EXPECT_THAT(check_section("(:action a :effect (increase (f) ?duration))"),
              HasSubstr("?duration has no meaning"));
  EXPECT_THAT(check_section("(:action a :effect (increase (f) #t))"), HasSubstr("#t has no meaning here"));
  EXPECT_THAT(check_section("(:durative-action a :duration (= ?duration ?duration))"),
              HasSubstr("?duration has no"));
  EXPECT_THAT(check_section("(:action a :parameters (?duration))"), HasSubstr("reserved"));
  EXPECT_EQ(check_section("(:durative-action a :duration () :effect (increase (f) (* #t 2)))"), "");
}

TEST(Check, ProtectsDerivedAndExternalValues) {
  const std::string derived = "(:derived (s ?x - thing) (q ?x))";
  EXPECT_THAT(check_section(derived + "(:action a :effect (s hammer))"),
              HasSubstr("derived predicate 's' is set"));
  EXPECT_THAT(check_problem("(s nail)"), HasSubstr("derived predicate 's' is set"));
  EXPECT_THAT(check_problem("(at 3 (s nail))"), HasSubstr("derived predicate 's' is set"));
  EXPECT_THAT(check_section("(:action a :effect (assign (cost hammer base) 3))"),
              HasSubstr("external function 'cost' is set"));
  EXPECT_THAT(check_problem("(= (cost nail pit) 3)"), HasSubstr("external function 'cost' is set"));
}

TEST(Check, FindsUnstratifiedDerivation) {
  EXPECT_THAT(check_section("(:derived (s ?x - thing) (not (q ?x))) (:derived (q ?x - thing) (s ?x))"),
              HasSubstr("depends on its own negation"));
  EXPECT_THAT(check_section("(:derived (zap) (p))"), HasSubstr("unknown predicate 'zap'"));
  EXPECT_THAT(check_section("(:derived (p ?x) (q ?x))"), HasSubstr("another arity"));
}

TEST(Check, FindsStartEffectsThatLookAhead) {
  EXPECT_THAT(
      check_section("(:durative-action a :duration () :effect (when (at end (p)) (at start (not (p)))))"),
      HasSubstr("depends on a condition of a later time"));
}

TEST(Check, FindsFaultsOfProblems) {
  const Domain other = parse_domain("(define (domain other) (:predicates (p)))", "o");
  EXPECT_THAT(
      findings_of(check(parse_problem("(define (problem x) (:domain d) (:init) (:goal (p)))", "x"), other)),
      HasSubstr("for domain 'd', not 'other'"));
  EXPECT_THAT(check_problem("(p) (not (p))"), HasSubstr("both true and false"));
  EXPECT_THAT(check_problem("(q pit)"), HasSubstr("'pit' is of type place"));
  EXPECT_THAT(check_problem("(at 3 (q saw))"), HasSubstr("unknown object 'saw'"));
  EXPECT_THAT(check_problem("(at 3 (= (h) 2))"), HasSubstr("unknown function 'h'"));
  EXPECT_THAT(check_problem("", "(zap)"), HasSubstr("x.pddl:4:8: error: unknown predicate 'zap'"));
}

TEST(Check, LoadingThrowsTheFirstFinding) {
  EXPECT_THROW(load_domain(domain_text("(:action a :effect (zap))"), "d"), ParseError);
  const Domain domain = load_domain(domain_text(""), "d");
  EXPECT_THROW(load_problem(problem_text("(zap)"), "x", domain), ParseError);
  EXPECT_EQ(load_problem(problem_text("(p)"), "x", domain).facts.size(), 1u);
}

}  // namespace
}  // namespace roci::pddl
