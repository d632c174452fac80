// Derived predicates and goals whose parameters and quantifiers range over very much: they cost no stack, and their
// work ends at a bound.
#include "exec_svc/problem/closed_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/pddl/check.hpp"
#include "core/pddl/parser.hpp"
#include "tests/unit/small_stack.hpp"

namespace roci::exec::problem {
namespace {

using temporal::Truth;
using ::testing::IsEmpty;

// One text for each i: before, i, after.
std::string repeated(const std::string& before, const std::string& after, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += before + std::to_string(i) + after;
  return text;
}

std::string many_times(const std::string& word, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += word;
  return text;
}

struct Judged {
  Truth truth = Truth::unknown;
  std::string given_up_at;
};

Judged judged(const std::string& domain, const std::string& problem, const std::string& goal) {
  const auto read = pddl::load_domain(
      "(define (domain d) (:requirements :derived-predicates) " + domain + ")", "domain.pddl");
  const auto tree =
      pddl::parse_problem("(define (problem p) (:domain d) " + problem + " (:goal " + goal + "))",
                          "problem.pddl", pddl::Strictness::tolerant);
  ClosedWorld world(read, tree);
  Judged out;
  out.truth = world.truth_of(tree.goal);
  out.given_up_at = world.given_up_at();
  return out;
}

TEST(ClosedWorld, ManyVariablesOfAGoalTakeNoStack) {
  small_stack::on_small_stack([] {
    const Judged all = judged("(:predicates (p ?x))", "(:objects o) (:init (p o))",
                              "(forall (" + repeated("?v", " ", 20000) + ") (p ?v19999))");
    EXPECT_EQ(all.truth, Truth::yes);
    EXPECT_THAT(all.given_up_at, IsEmpty());
  });
}

TEST(ClosedWorld, ManyParametersOfADerivedPredicateTakeNoStack) {
  small_stack::on_small_stack([] {
    const std::string parameters = repeated("?v", " ", 20000);
    const Judged one =
        judged("(:predicates (p ?x) (d " + parameters + ")) (:derived (d " + parameters + ") (p ?v19999))",
               "(:objects o) (:init (p o))", "(d" + many_times(" o", 20000) + ")");
    EXPECT_EQ(one.truth, Truth::yes);
    EXPECT_THAT(one.given_up_at, IsEmpty());
  });
}

// As deep as a text may nest.
TEST(ClosedWorld, NestedQuantifiersFitOnASmallStack) {
  small_stack::on_small_stack([] {
    std::string goal = "(p ?v0)";
    for (int i = 0; i < 190; ++i)
      goal = "(" + std::string(i % 2 == 0 ? "forall" : "exists") + " (?v" + std::to_string(i) + ") " + goal +
             ")";
    EXPECT_EQ(judged("(:predicates (p ?x))", "(:objects o) (:init (p o))", goal).truth, Truth::yes);
  });
}

TEST(ClosedWorld, ADerivedPredicateOverTooManyObjectsIsGivenUpAndNamed) {
  const Judged out =
      judged("(:predicates (p ?x) (d ?a ?b ?c ?e ?f ?g))\n(:derived (d ?a ?b ?c ?e ?f ?g) (p ?a))",
             "(:objects" + repeated(" o", "", 100) + ") (:init (p o0))", "(d o0 o1 o2 o3 o4 o5)");
  EXPECT_EQ(out.truth, Truth::unknown);
  EXPECT_EQ(out.given_up_at, "derived predicate 'd' (domain.pddl:2:11)");
}

TEST(ClosedWorld, AGoalOverTooManyObjectsIsGivenUp) {
  const Judged out = judged("(:predicates (p ?x))", "(:objects" + repeated(" o", "", 100) + ") (:init)",
                            "(exists (?a ?b ?c ?d ?e) (p ?e))");
  EXPECT_EQ(out.truth, Truth::unknown);
  EXPECT_EQ(out.given_up_at, "a quantifier of the goal");
}

TEST(ClosedWorld, WhatNoGoalAsksForIsNotDerived) {
  const Judged out = judged(
      "(:predicates (p ?x) (d ?a ?b ?c ?e ?f ?g))\n(:derived (d ?a ?b ?c ?e ?f ?g) (p ?a))",
      "(:objects" + repeated(" o", "", 100) + ") (:init (p o0))", "(forall (?x) (or (p ?x) (not (p ?x))))");
  EXPECT_EQ(out.truth, Truth::yes);
  EXPECT_THAT(out.given_up_at, IsEmpty());
}

TEST(ClosedWorld, EveryChoiceOfObjectsIsLookedAt) {
  const std::string predicates = "(:predicates (p ?x ?y))";
  const std::string all =
      "(:objects a b c) (:init (p a a) (p a b) (p a c) (p b a) (p b b) (p b c) (p c a) (p c b)";
  EXPECT_EQ(judged(predicates, all + ")", "(forall (?x ?y) (p ?x ?y))").truth, Truth::no);
  EXPECT_EQ(judged(predicates, all + " (p c c))", "(forall (?x ?y) (p ?x ?y))").truth, Truth::yes);
  EXPECT_EQ(judged(predicates, "(:objects a b c) (:init (p c b))", "(exists (?x ?y) (p ?x ?y))").truth,
            Truth::yes);
  EXPECT_EQ(judged(predicates, "(:init)", "(exists (?x ?y) (p ?x ?y))").truth, Truth::no)
      << "no object at all";
  EXPECT_EQ(judged(predicates, "(:init)", "(forall (?x ?y) (p ?x ?y))").truth, Truth::yes);
}

}  // namespace
}  // namespace roci::exec::problem
