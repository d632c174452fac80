// What the engine does not take is refused with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/parser.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {

using engine::NoFunctions;

namespace {

using temporal::Verdict;

void expect_failure(const Result& result, Verdict verdict, int line, const char* words) {
  EXPECT_EQ(result.verdict, verdict) << result.reason;
  EXPECT_THAT(result.reason, ::testing::HasSubstr(words));
  ASSERT_TRUE(result.where) << result.reason;
  EXPECT_EQ(result.where->where.line, line);
  EXPECT_FALSE(result.plan);
}

TEST(PlanningFailures, ProductsOfNumbersThatChange) {
  const auto made = testing::model(R"((:requirements :numeric-fluents)
    (:predicates (g)) (:functions (x) (y))
    (:action a :parameters () :precondition
      (>= (* (x) (y)) 2) :effect (and (g) (increase (x) 1) (increase (y) 1))))",
                                   "(:init (= (x) 0) (= (y) 0)) (:goal (g))");
  expect_failure(testing::solved(made), Verdict::unsupported, 5, "not linear");
}

TEST(PlanningFailures, ContinuousEffects) {
  const auto made = testing::model(R"((:requirements :durative-actions :continuous-effects :numeric-fluents)
    (:predicates (g)) (:functions (x))
    (:durative-action a :parameters () :duration (= ?duration 1) :condition ()
      :effect (and (at end (g))
        (increase (x) (* #t 2)))))",
                                   "(:init (= (x) 0)) (:goal (g))");
  expect_failure(testing::solved(made), Verdict::unsupported, 6, "a");
}

TEST(PlanningFailures, TooManyAlternatives) {
  std::string objects;
  for (int i = 0; i < 10; ++i) objects += " o" + std::to_string(i);
  const auto made = testing::model(R"((:requirements :adl)
    (:predicates (p ?x) (q ?x) (g))
    (:action set :parameters (?x) :precondition () :effect (and (p ?x) (q ?x)))
    (:action unset :parameters (?x) :precondition () :effect (and (not (p ?x)) (not (q ?x))))
    (:action a :parameters ()
      :precondition (forall (?x) (or (p ?x) (q ?x)))
      :effect (g)))",
                                   "(:objects" + objects + ") (:init) (:goal (g))");
  expect_failure(testing::solved(made), Verdict::unsupported, 7, "alternatives");
}

TEST(PlanningFailures, WhatContradictsItself) {
  NoFunctions functions;
  const auto domain = pddl::parse_domain(
      "(define (domain d)\n(:predicates (p))\n(:action a :parameters ()\n:effect (q)))", "d.pddl");
  const auto problem = pddl::parse_problem("(define (problem x) (:domain d) (:init) (:goal (p)))", "p.pddl");
  expect_failure(plan(domain, problem, functions, {}, {}), Verdict::invalid_input, 4, "d.pddl:4");
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
