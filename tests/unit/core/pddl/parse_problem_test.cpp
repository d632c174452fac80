#include <gtest/gtest.h>

#include "core/pddl/printer.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

TEST(ParseProblem, ReadsEveryKindOfFact) {
  const Problem problem = problem_with(
      "(p) (q nail) (not (s nail)) (= (f) 3) (= (g nail) -0.5)"
      " (at 5 (p)) (at 7.5 (not (p))) (at 9 (= (f) 4)) (at nail pit)");
  EXPECT_EQ(problem.name, "x");
  EXPECT_EQ(problem.domain_name, "d");
  ASSERT_EQ(problem.facts.size(), 3u);
  EXPECT_EQ(print(problem.facts[2]), "(at nail pit)") << "a predicate may be called at";
  ASSERT_EQ(problem.false_facts.size(), 1u);
  EXPECT_EQ(print(problem.false_facts[0]), "(s nail)");
  ASSERT_EQ(problem.values.size(), 2u);
  EXPECT_EQ(problem.values[1].value, -0.5);
  ASSERT_EQ(problem.timed_literals.size(), 2u);
  EXPECT_EQ(problem.timed_literals[0].time, 5);
  EXPECT_FALSE(problem.timed_literals[0].literal.negated);
  EXPECT_EQ(problem.timed_literals[1].time, 7.5);
  EXPECT_TRUE(problem.timed_literals[1].literal.negated);
  ASSERT_EQ(problem.timed_values.size(), 1u);
  EXPECT_EQ(problem.timed_values[0].time, 9);
  EXPECT_EQ(problem.timed_values[0].value, 4);
}

TEST(ParseProblem, ReadsGoalAndMetric) {
  const Problem problem = parse_problem(
      "(define (problem x) (:domain d) (:init) (:goal (and (p) (>= (f) 2)))"
      " (:metric minimize (+ (* 2 (total-time)) (f) total-time)))",
      "x.pddl");
  EXPECT_EQ(print(problem.goal), "(and (p) (>= (f) 2))");
  ASSERT_TRUE(problem.metric);
  EXPECT_EQ(problem.metric->sense, Metric::Sense::minimize);
  EXPECT_EQ(print(problem.metric->expression), "(+ (* 2 (total-time)) (f) (total-time))");
}

TEST(ParseProblem, KnowsPlaces) {
  const Problem problem =
      parse_problem("(define (problem x)\n(:domain d) (:init\n  (at 5 (p)))\n (:goal (p)))", "x");
  EXPECT_EQ(problem.timed_literals[0].where, (SourceLocation{3, 3}));
  EXPECT_EQ(problem.goal.where, (SourceLocation{4, 9}));
}

}  // namespace
}  // namespace roci::pddl
