// A number without an initial value is undefined until it is assigned: the planner says so and plans
// accordingly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/printer.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using temporal::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kVan = R"((:requirements :typing :durative-actions :numeric-fluents) (:types place van)
    (:predicates (at ?v - van ?p - place)) (:functions (fuel ?v - van) (time ?a ?b - place))
    (:durative-action go :parameters (?v - van ?a ?b - place) :duration (= ?duration 5)
      :condition (at start (at ?v ?a))
      :effect (and (at start (not (at ?v ?a))) (at end (at ?v ?b)) (at end (decrease (fuel ?v) 3))))
    (:durative-action fill :parameters (?v - van) :duration (= ?duration 2)
      :effect (at end (assign (fuel ?v) 10))))";

constexpr const char* kTwoVans = "(:objects v w - van a b - place)";

TEST(UndefinedNumbers, WhatChangesOneWaitsForAnAssignment) {
  const auto model = testing::model(kVan, std::string(kTwoVans) + "(:init (at v a)) (:goal (at v b))");
  const Result result = testing::solved(model);
  testing::expect_valid(model, result);
  ASSERT_EQ(result.plan->activities.size(), 2u);
  EXPECT_EQ(result.plan->activities.front().name, "fill");
  EXPECT_THAT(result.warnings, IsEmpty());
}

// (- (f) (f)) and (* 0 (f)) are 0, but only once (f) has a value.
TEST(UndefinedNumbers, OneThatCancelsIsReadAllTheSame) {
  const std::string uses = R"((:requirements :numeric-fluents) (:predicates (done)) (:functions (f) (g))
    (:action subtract :parameters () :precondition (>= (- (f) (f)) 0) :effect (done)))";
  const std::string scales = R"((:requirements :numeric-fluents) (:predicates (done)) (:functions (f) (g))
    (:action scale :parameters () :precondition () :effect (and (increase (g) (* 0 (f))) (done))))";
  const std::string sets = "(:action set :parameters () :precondition () :effect (assign (f) 3))";
  const std::string problem = "(:init (= (g) 0)) (:goal (done))";
  for (const std::string& domain : {uses, scales}) {
    const auto made = testing::model(domain + sets, problem);
    const Result result = testing::solved(made);
    testing::expect_valid(made, result);
    EXPECT_EQ(result.plan->activities.size(), 2u) << domain;
    const Result without = testing::solved(testing::model(domain, problem));
    EXPECT_EQ(without.verdict, Verdict::unsolvable) << domain;
    EXPECT_THAT(without.reason, HasSubstr("reads (f), which has no value")) << domain;
    const Result given =
        testing::solved(testing::model(domain, "(:init (= (g) 0) (= (f) 1)) (:goal (done))"));
    ASSERT_TRUE(given.plan) << domain;
    EXPECT_EQ(given.plan->activities.size(), 1u) << domain;
  }
}

// The domain without what assigns the number.
std::string never_filled() {
  const std::string domain = kVan;
  return domain.substr(0, domain.find("(:durative-action fill"));
}

TEST(UndefinedNumbers, TheVerdictAndAWarningNameTheFunctionAndTheMissingLine) {
  const Result result = testing::solved(
      testing::model(never_filled(), std::string(kTwoVans) + "(:init (at v a)) (:goal (at v b))"));
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.reason, HasSubstr("(go v ? b) reads (fuel v), which has no value"));
  EXPECT_THAT(result.reason, HasSubstr("(= (fuel v) …)"));
  EXPECT_THAT(result.reason, Not(HasSubstr("nan")));
  EXPECT_THAT(result.warnings,
              ElementsAre(HasSubstr("problem.pddl:1:1: warning: (fuel v) has no initial value")));
  EXPECT_THAT(result.warnings.front(), HasSubstr("(add (= (fuel v) …) to :init)"));
}

TEST(UndefinedNumbers, OneVanIsFuelledAndTheOtherIsNot) {
  const auto model = testing::model(
      never_filled(), std::string(kTwoVans) + "(:init (at v a) (at w a) (= (fuel w) 9)) (:goal (at w b))");
  const Result result = testing::solved(model);
  testing::expect_valid(model, result);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("(fuel v) has no initial value")));
}

TEST(UndefinedNumbers, NoConditionHoldsOnOneAndNoReasonSpeaksOfNan) {
  const Result result = testing::solved(testing::model(
      R"((:requirements :numeric-fluents) (:predicates (p) (g)) (:functions (heat))
      (:action cool :parameters () :precondition (p) :effect (decrease (heat) 1))
      (:action a :parameters () :precondition (< (heat) 5) :effect (g)))",
      "(:init (p)) (:goal (g))"));
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.reason, HasSubstr("(a) reads (heat), which has no value"));
  EXPECT_THAT(result.reason, Not(HasSubstr("nan")));
}

TEST(UndefinedNumbers, AMissingConstantIsNamedWhereAnActionAsksForIt) {
  const Result result = testing::solved(testing::model(
      R"((:requirements :typing :durative-actions :numeric-fluents) (:types place)
      (:predicates (at ?p - place) (link ?a ?b - place)) (:functions (time ?a ?b - place))
      (:durative-action go :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))
        :condition (and (at start (at ?a)) (at start (link ?a ?b)))
        :effect (and (at start (not (at ?a))) (at end (at ?b)))))",
      R"((:objects a b c - place) (:init (at a) (link a b) (link b c) (= (time a b) 2)) (:goal (at c)))"));
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("(add (= (time b c) …) to :init)")));
}

TEST(UndefinedNumbers, ATimedValueDefinesOneFromThenOn) {
  const auto model = testing::model(
      never_filled(), std::string(kTwoVans) + "(:init (at v a) (at 7 (= (fuel v) 4))) (:goal (at v b))");
  const Result result = testing::solved(model);
  testing::expect_valid(model, result);
  EXPECT_GT(result.plan->makespan, temporal::Duration(7'000'000));
}

TEST(UndefinedNumbers, TotalCostBeginsAtZero) {
  const auto model = testing::model(
      R"((:requirements :action-costs) (:predicates (g)) (:functions (total-cost) (price))
      (:action buy :parameters () :precondition () :effect (and (g) (increase (total-cost) (price)))))",
      "(:init (= (price) 3)) (:goal (and (g) (<= (total-cost) 3))) (:metric minimize (total-cost))");
  const Result result = testing::solved(model);
  testing::expect_valid(model, result);
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_EQ(result.plan->metric, 3);
}

class RandomUndefinedNumbers : public ::testing::TestWithParam<int> {};

TEST_P(RandomUndefinedNumbers, EveryPlanIsValidAndNoSwitchChangesTheVerdict) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()));
  call::Budget budget;
  budget.evaluations = 500;
  call::Options bare;
  bare.compression_safety = bare.dominance = bare.landmarks = bare.lookahead = false;
  bare.windows = call::WindowExtraction::none;
  std::size_t solved = 0, asked = 0;
  for (int round = 0; round < 150; ++round) {
    testing::Model model = testing::random_task(random);
    model.problem.values.clear();
    SCOPED_TRACE(pddl::print(model.domain) + pddl::print(model.problem));
    const Result result = testing::solved(model, {}, budget), other = testing::solved(model, bare, budget);
    if (result.plan) testing::expect_valid(model, result);
    if (other.plan) testing::expect_valid(model, other, bare);
    EXPECT_FALSE(result.verdict == Verdict::solved && other.verdict == Verdict::unsolvable) << other.reason;
    EXPECT_FALSE(other.verdict == Verdict::solved && result.verdict == Verdict::unsolvable) << result.reason;
    solved += result.verdict == Verdict::solved;
    asked += !result.warnings.empty() ||
             (result.plan && testing::number(testing::grounded(model).task, "(x)").index() == 0);
  }
  EXPECT_GT(solved, 20u);
  EXPECT_GT(asked, 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomUndefinedNumbers, ::testing::Values(1, 2));

}  // namespace
}  // namespace roci::planner::temporal_pddl
