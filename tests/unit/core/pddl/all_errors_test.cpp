// All that is wrong with a file is told at once, at the places where it goes wrong, with the word that was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/check.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

template <typename Load>
std::vector<std::string> findings_of(Load load) {
  std::vector<std::string> lines;
  try {
    load();
  } catch (const ParseError& error) {
    for (const Diagnostic& one : error.diagnostics()) lines.push_back(to_string(one));
  }
  return lines;
}

std::vector<std::string> domain_findings(const std::string& text) {
  return findings_of([&] { load_domain(text, "d"); });
}

// In a domain with the declarations of texts.hpp; the section begins in line 7.
std::vector<std::string> section_findings(const std::string& section) {
  return domain_findings(domain_text(section));
}

std::vector<std::string> problem_findings(const std::string& init, const std::string& goal) {
  return findings_of([&] { load_problem(problem_text(init, goal), "x", load_domain(domain_text(""), "d")); });
}

auto at(int line, int column, const std::string& words) {
  const std::string place = ":" + std::to_string(line) + ":" + std::to_string(column) + ": error: ";
  return AllOf(HasSubstr(place), HasSubstr(words));
}

TEST(AllErrors, OfOneFileAreToldAtOnceInItsOrder) {
  EXPECT_THAT(section_findings("(:action go :parameters (?t - thing)\n"
                               " :precondition (and (p) (zap) (q ?x))\n"
                               " :effects (p))\n"
                               "(:axiom)\n"
                               "(:action stop :parameters (t)\n"
                               " :effect (q t))\n"
                               "(:action wait :precondition (and (not) (< (f) (h)) (p ?))\n"
                               " :effect (and (p) (or (p)) (q hamer)))"),
              ElementsAre(at(8, 25, "unknown predicate 'zap'"), at(8, 34, "unbound variable '?x'"),
                          at(9, 2, "did you mean ':effect'"), at(10, 1, "unknown section ':axiom'"),
                          at(11, 28, "write ?t"), at(13, 34, "'not' with 0 parts"),
                          at(13, 47, "unknown function 'h'"), at(13, 55, "a variable without a name"),
                          at(14, 19, "'or' in an effect"), at(14, 31, "did you mean 'hammer'")));
  EXPECT_THAT(
      problem_findings("(q nial) p (at -1 (p)) (= (f) x) (q nail pit)", "(and (q nail) (zap) (q pit))"),
      ElementsAre(at(3, 11, "did you mean 'nail'"), at(3, 17, "'p'"), at(3, 23, "before 0"),
                  at(3, 38, "a number expected"), at(3, 41, "2 arguments"), at(4, 22, "unknown predicate"),
                  at(4, 31, "of type place")));
}

TEST(AllErrors, WhatCannotBeReadHidesNothingAndIsNotMissedElsewhere) {
  EXPECT_THAT(
      domain_findings(
          "(define (domain d) (:requirements :typing)\n(:types a -)\n(:predicates (p ?x - b) (q 3))\n"
          "(:action go :parameters (?x - c) :precondition (and (r ?x) (p ?z))))"),
      ElementsAre(at(2, 11, "'-' without a type"), at(3, 28, "write ?3"), at(4, 63, "unbound variable '?z'")))
      << "b, c and r may stand in what could not be read";
}

TEST(AllErrors, AreBounded) {
  std::string facts;
  for (int i = 0; i < 300; ++i) facts += "(unheard" + std::to_string(i) + ")\n";
  try {
    load_problem(problem_text(facts), "x", load_domain(domain_text(""), "d"));
    ADD_FAILURE();
  } catch (const ParseError& error) {
    EXPECT_EQ(error.diagnostics().size(), 50U);
    EXPECT_EQ(error.untold(), 250U);
    EXPECT_THAT(error.what(), HasSubstr("\nand 250 more"));
  }
  facts.clear();
  for (int i = 0; i < 300; ++i) facts += "(zap)\n";
  const auto alike = problem_findings(facts, "(zup)");
  EXPECT_EQ(alike.size(), 6U) << "of those alike five";
  EXPECT_THAT(alike[4], HasSubstr("and so in 295 more places"));
}

TEST(AllErrors, AnUnknownTypeIsToldWhereItIsDeclaredAndNotWhereItIsUsed) {
  EXPECT_THAT(section_findings("(:action a :parameters (?t - tol) :precondition (and (q ?t) (s ?t)))"),
              ElementsAre(HasSubstr("unknown type 'tol' of '?t'")));
  EXPECT_THAT(section_findings(
                  "(:predicates (held ?t - tol))(:action a :parameters (?t - tool) :precondition (held ?t))"),
              ElementsAre(HasSubstr("unknown type 'tol' of '?t'")));
}

TEST(AllErrors, NearestWordOfEachKind) {
  EXPECT_THAT(section_findings("(:action a :parameters (?t - tol) :precondition (p))"),
              ElementsAre(HasSubstr("unknown type 'tol' of '?t' (did you mean 'tool'?")));
  EXPECT_THAT(section_findings("(:predicates (carried))(:action a :precondition (carired))"),
              ElementsAre(HasSubstr("did you mean 'carried'?")));
  EXPECT_THAT(section_findings("(:functions (battery))(:action a :precondition (< (batery) 1))"),
              ElementsAre(HasSubstr("did you mean 'battery'?")));
  EXPECT_THAT(section_findings("(:action a :parameters (?from - thing) :precondition (q ?form))"),
              ElementsAre(HasSubstr("did you mean '?from'?")));
  EXPECT_THAT(section_findings("(:action a :parameters (?from - thing) :precondition (q from))"),
              ElementsAre(HasSubstr("did you mean the variable '?from'?")));
  EXPECT_THAT(section_findings("(:action a :precondition (q hammre))"),
              ElementsAre(HasSubstr("did you mean 'hammer'?")));
  EXPECT_THAT(section_findings("(:durative-acton a :duration ())"),
              ElementsAre(HasSubstr("did you mean ':durative-action'?")));
  EXPECT_THAT(section_findings("(:action a :preconditions (p))"),
              ElementsAre(HasSubstr("did you mean ':precondition'?")));
  EXPECT_THAT(section_findings("(:action a :precondition (nad (p) (p)))"),
              ElementsAre(HasSubstr("did you mean 'and'?")));
  EXPECT_THAT(section_findings("(:action a :effect (increse (f) 1))"),
              ElementsAre(HasSubstr("did you mean 'increase'?")));
  EXPECT_THAT(section_findings("(:action a :precondition (f))"), ElementsAre(HasSubstr("it is a function")));
  EXPECT_THAT(section_findings("(:action a :precondition (xylophone))"),
              ElementsAre(AllOf(HasSubstr("(declare it in :predicates)"), Not(HasSubstr("did you mean")))));
}

// ---- Parentheses

TEST(AllErrors, AnActionInsideAnActionIsToldThere) {
  EXPECT_THAT(
      section_findings("(:action go\n"
                       "  :effect (and (p) (zap))\n"
                       "(:action stop\n"
                       "  :effect (p zip))\n"),
      ElementsAre(at(8, 20, "unknown predicate 'zap'"),
                  at(9, 1, "'(:action' begins inside of '(:action go' of line 7: 1 ')' is missing before it"),
                  at(10, 11, "predicate 'p' has 1 arguments")));
  EXPECT_THAT(
      section_findings("(:action go\n  :effect (and\n    (q hammer\n    (p)))\n(:action stop :effect (p))"),
      ElementsAre(at(10, 5, "'q' is a list"), at(11, 1, "look at the '(' in line 9, column 5")))
      << "the indentation says which";
}

TEST(AllErrors, AGoalInsideOfTheInitialStateIsToldThere) {
  EXPECT_THAT(findings_of([] {
                load_problem("(define (problem x) (:domain d)\n(:init (p)\n(:goal (p)))\n", "x",
                             load_domain(domain_text(""), "d"));
              }),
              ElementsAre(at(3, 1, "'(:goal' begins inside of '(:init")));
}

TEST(AllErrors, AParenthesisTooManyIsToldWhereItStands) {
  EXPECT_THAT(section_findings(
                  "(:action go :parameters (?t - tool))\n :effect (q ?t))\n(:action stop :effect (p zip))"),
              ElementsAre(at(7, 36, "this ')' closes '(:action go', but its :effect follows in line 8"),
                          at(9, 23, "1 arguments")));
  EXPECT_THAT(
      domain_findings(
          "(define (domain d)\n(:predicates (p)))\n(:action go :effect (p))\n(:action stop :effect (q)))"),
      ElementsAre(at(2, 18, "closes (define …), but '(:action' follows in line 3"),
                  at(4, 23, "unknown predicate 'q'")));
}

TEST(AllErrors, AnUnclosedParenthesisAtTheEndIsToldByTheIndentation) {
  EXPECT_THAT(domain_findings(
                  "(define (domain d)\n  (:predicates (p))\n  (:action go\n    :effect (and (p)\n  )\n)\n"),
              ElementsAre(at(5, 3, "the '(' in line 4, column 13 should be closed before this")));
  EXPECT_THAT(domain_findings("(define (domain d)\n  (:predicates (p))\n  (:action go\n    :effect (p))\n"),
              ElementsAre(at(4, 16, "'(define' of line 1 is never closed")));
}

// ---- What is not supported

TEST(AllErrors, WhatIsNotSupportedIsToldApart) {
  const auto unsupported = [](const std::string& text) {
    try {
      load_domain(text, "d");
    } catch (const ParseError& error) {
      return error.unsupported();
    }
    return false;
  };
  const auto in_action = [&](const std::string& condition, const std::string& effect = "(p)") {
    return unsupported(domain_text("(:action a :precondition " + condition + " :effect " + effect + ")"));
  };
  EXPECT_TRUE(in_action("(preference n (p))"));
  EXPECT_TRUE(in_action("(always (p))"));
  EXPECT_TRUE(in_action("(p)", "(probabilistic 0.5 (p))"));
  EXPECT_TRUE(in_action("(p)", "(oneof (p) (not (p)))"));
  EXPECT_TRUE(unsupported(domain_text("(:constraints (and (always (p))))")));
  EXPECT_TRUE(unsupported(domain_text("(:process x :effect (p))")));
  EXPECT_TRUE(unsupported(domain_text("(:event x :effect (p))")));
  EXPECT_TRUE(unsupported(domain_text("(:task go :parameters ())")));
  EXPECT_TRUE(unsupported(domain_text("(:functions (where ?x - thing) - place)")));
  EXPECT_TRUE(unsupported(domain_text("(:constraints (p)) (:axiom)")))
      << "an error beside it changes nothing";
  EXPECT_FALSE(in_action("(zap)"));
  EXPECT_FALSE(in_action("(nad (p) (p))"));
}

}  // namespace
}  // namespace roci::pddl
