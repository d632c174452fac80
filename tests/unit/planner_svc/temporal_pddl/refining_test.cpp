// Few exact values (R39): plans of the modes lazy and two_accuracy stand on exact values alone, cost what
// they cost when everything is known, and take fewer of them.
#include "planner_svc/temporal_pddl/refining.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "core/pddl/check.hpp"
#include "planner_svc/temporal_pddl/checker/refusal.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"
#include "tests/unit/planner_svc/temporal_pddl/two_accuracies.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options;
using engine::FunctionOutcome, engine::FunctionUse, engine::FunctionsMode;
using temporal::FunctionAccuracy, temporal::Verdict;
using ::testing::AllOf, ::testing::HasSubstr, ::testing::Not, ::testing::SizeIs;
using testing::TwoAccuracies;

constexpr std::size_t kToTheEnd = std::numeric_limits<std::size_t>::max();

Options in_mode(FunctionsMode mode, std::size_t improvement = 0) {
  Options options;
  options.functions = mode;
  options.improvement_evaluations = improvement;
  return options;
}

std::string place(std::size_t i) { return "p" + std::to_string(i); }
std::string way(std::size_t a, std::size_t b) { return "(time " + place(a) + " " + place(b) + ")"; }

// A rover that begins at p0 and is to visit p1 … p(goals), on roads between all places unless `roads` says less.
testing::Model tour(std::size_t places, std::size_t goals, const std::string& condition = "",
                    const std::string& more = "") {
  std::string objects, goal;
  for (std::size_t i = 0; i < places; ++i) objects += place(i) + " ";
  for (std::size_t i = 1; i <= goals; ++i) goal += "(visited " + place(i) + ")";
  return testing::model(R"((:requirements :typing :durative-actions) (:types place)
    (:modules (:module roads (:function (time ?a ?b - place))))
    (:predicates (at ?p - place) (visited ?p - place) (road ?a ?b - place)) (:functions (charge))
    (:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (time ?a ?b))
      :condition (and (at start (at ?a)) )" +
                            condition + R"()
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (visited ?b)))))",
                        "(:objects " + objects + "- place) (:init (at p0) (= (charge) 100) " + more +
                            ") (:goal (and " + goal + ")) (:metric minimize (total-time))");
}

struct Distances {
  TwoAccuracies owner;
  std::vector<std::vector<double>> exact;
};

// Whole seconds from 10 to 60; bounds are from 40 to 100 % of them.
Distances random_distances(std::size_t places, std::uint32_t seed) {
  std::mt19937 random(seed);
  Distances made;
  made.exact.assign(places, std::vector<double>(places, 0));
  for (std::size_t a = 0; a < places; ++a) {
    for (std::size_t b = 0; b < places; ++b) {
      const double value = 10 + static_cast<double>(random() % 51);
      made.exact[a][b] = value;
      made.owner.set(way(a, b), value, std::floor(value * (0.4 + 0.01 * static_cast<double>(random() % 61))));
    }
  }
  return made;
}

// The shortest walk from 0 over 1 … goals, in seconds: all orders of them on shortest ways.
double shortest_tour(std::vector<std::vector<double>> far, std::size_t goals) {
  const std::size_t n = far.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) far[a][b] = std::min(far[a][b], far[a][k] + far[k][b]);
  std::vector<std::size_t> order(goals);
  for (std::size_t i = 0; i < goals; ++i) order[i] = i + 1;
  double best = std::numeric_limits<double>::max();
  do {
    double length = 0;
    std::size_t from = 0;
    for (const std::size_t to : order) length += far[std::exchange(from, to)][to];
    best = std::min(best, length);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

double seconds(const Result& result) { return std::chrono::duration<double>(result.plan->makespan).count(); }

void expect_sound(const testing::Model& model, const Result& result) {
  ASSERT_EQ(result.verdict, Verdict::solved) << result.reason;
  const auto steps = pddl::parse_plan(to_ipc(*result.plan), "plan");
  EXPECT_EQ(checker::refusal(model.domain, model.problem, steps, result.functions), "");
}

TEST(Refining, SearchedToTheEndEveryModeCostsTheOptimum) {
  std::size_t eager = 0, two_accuracy = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const testing::Model model = tour(5, 2);
    const double optimum = shortest_tour(random_distances(5, seed).exact, 2);
    for (const FunctionsMode mode :
         {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
      Distances distances = random_distances(5, seed);
      const Result result = testing::solved(model, distances.owner, in_mode(mode, kToTheEnd));
      expect_sound(model, result);
      EXPECT_TRUE(result.statistics.exhausted) << seed << to_string(mode);
      EXPECT_NEAR(seconds(result), optimum, 0.1) << seed << to_string(mode);
      EXPECT_EQ(distances.owner.asked_again, 0U);
      EXPECT_EQ(result.statistics.exact_values, distances.owner.asked_exactly.size());
      if (mode == FunctionsMode::eager) eager += result.statistics.exact_values;
      if (mode == FunctionsMode::two_accuracy) two_accuracy += result.statistics.exact_values;
    }
  }
  EXPECT_EQ(eager, 5U * 25U);
  EXPECT_LT(two_accuracy, eager / 2);
}

// The way by p3, p4 and p5 promises 24 s beside 30 s that are known; its first half alone takes more.
TEST(Refining, APlanThatIsTooDearByHalfIsAskedForNoFurther) {
  std::string roads;
  TwoAccuracies owner;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) owner.set(way(a, b), 100, 100);
  const auto road = [&](std::size_t a, std::size_t b, double value, double bound) {
    roads += "(road " + place(a) + " " + place(b) + ")";
    owner.set(way(a, b), value, bound);
  };
  road(0, 2, 15, 10);
  road(2, 1, 15, 10);
  for (const auto& [a, b] : {std::pair(0, 3), std::pair(3, 4), std::pair(4, 5), std::pair(5, 1)})
    road(static_cast<std::size_t>(a), static_cast<std::size_t>(b), 20, 6);
  const Result result = testing::solved(tour(6, 1, "(at start (road ?a ?b))", roads), owner,
                                        in_mode(FunctionsMode::two_accuracy, kToTheEnd));
  EXPECT_EQ(result.verdict, Verdict::solved) << result.reason;
  EXPECT_TRUE(result.statistics.exhausted);
  EXPECT_NEAR(seconds(result), 30, 0.1);
  EXPECT_THAT(owner.asked_exactly,
              ::testing::ElementsAre("(time p0 p2)", "(time p0 p3)", "(time p2 p1)", "(time p3 p4)"));
}

TEST(Refining, TheFirstPlanIsTimedWithExactValuesAndTaken) {
  const testing::Model model = tour(6, 2);
  Distances distances = random_distances(6, 1);
  const Result result = testing::solved(model, distances.owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  EXPECT_EQ(distances.owner.asked_exactly.size(), result.plan->activities.size());
  EXPECT_EQ(distances.owner.batches, 2U) << "all bounds, and the plan's own values";
  EXPECT_EQ(result.statistics.cheap_values, 36U);
  for (const auto& activity : result.plan->activities) {
    const std::string tuple = "(time " + activity.arguments[0] + " " + activity.arguments[1] + ")";
    EXPECT_EQ(std::chrono::duration<double>(activity.end - activity.start).count(),
              distances.owner.exact.at(tuple).value);
  }
}

// The checker's part: it hears exact values alone.
TEST(Refining, APlanOnABoundIsRefused) {
  const testing::Model model = tour(2, 1);
  Distances distances = random_distances(2, 1);
  Result result = testing::solved(model, distances.owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  for (FunctionUse& use : result.functions) use.answer.accuracy = FunctionAccuracy::lower_bound;
  const auto steps = pddl::parse_plan(to_ipc(*result.plan), "plan");
  EXPECT_THAT(checker::refusal(model.domain, model.problem, steps, result.functions),
              HasSubstr("time p0 p1"));
}

TEST(Refining, WhereThePlanDoesNotHoldWithExactValuesAnotherIsFound) {
  // The direct way looks cheap and takes more than there is.
  const testing::Model model = tour(3, 1, "(at start (>= (charge) (time ?a ?b)))");
  TwoAccuracies owner;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) owner.set(way(a, b), 40, 40);
  owner.set(way(0, 1), 150, 5);
  const Result result = testing::solved(model, owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  EXPECT_THAT(result.plan->activities, SizeIs(2));
  EXPECT_THAT(owner.asked_exactly, ::testing::ElementsAre("(time p0 p1)", "(time p0 p2)", "(time p2 p1)"));
}

// Six of seven ways by one place each look affordable by their bounds and are not; each takes a round to find out.
TEST(Refining, BetterCheapPlansTakeNothingOfWhatTheFirstPlanMayTake) {
  std::string roads;
  TwoAccuracies owner;
  for (std::size_t a = 0; a < 9; ++a)
    for (std::size_t b = 0; b < 9; ++b) owner.set(way(a, b), 60, 60);
  for (std::size_t by = 2; by < 9; ++by) {
    roads += "(road p0 " + place(by) + ")(road " + place(by) + " p1)";
    const bool affordable = by == 8;
    owner.set(way(by, 1), affordable ? 60 : 150, affordable ? 60 : 5 + static_cast<double>(by));
  }
  const testing::Model model =
      tour(9, 1, "(at start (road ?a ?b)) (at start (>= (charge) (time ?a ?b)))", roads);
  call::Budget budget;
  budget.evaluations = 100;
  for (const FunctionsMode mode : {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
    const Result result =
        plan(model.domain, model.problem, owner, budget, {}, in_mode(mode, /*improvement=*/50));
    SCOPED_TRACE(to_string(mode));
    expect_sound(model, result);
    ASSERT_TRUE(result.plan);
    ASSERT_THAT(result.plan->activities, SizeIs(2));
    EXPECT_EQ(result.plan->activities[0].arguments[1], "p8");
    if (mode != FunctionsMode::eager) {
      EXPECT_GT(result.statistics.evaluated, budget.evaluations + 50) << "in many rounds";
    }
  }
}

TEST(Refining, ABoundAboveTheExactValueIsNamedAndTheExactOneCounts) {
  const testing::Model model = tour(2, 1);
  TwoAccuracies owner;
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) owner.set(way(a, b), 30, 20);
  owner.set(way(0, 1), 25, 28);
  const Result result = testing::solved(model, owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  EXPECT_NEAR(seconds(result), 25, 0.01);
  EXPECT_THAT(result.warnings,
              ::testing::ElementsAre(
                  AllOf(HasSubstr("arm_svc gave 28 as a lower bound of (time p0 p1) of module roads"),
                        HasSubstr("25"), HasSubstr("the exact value counts"))));
}

// A bound that does not admit what the exact value admits costs time, and no plan.
TEST(Refining, NoVerdictStandsOnCheapValues) {
  const testing::Model model = tour(2, 1, "(at start (<= 20 (time ?a ?b)))");
  for (const FunctionsMode mode : {FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
    TwoAccuracies owner;
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 0; b < 2; ++b) owner.set(way(a, b), 30, 10);
    expect_sound(model, testing::solved(model, owner, in_mode(mode)));
    owner.set(way(0, 1), 15, 10);
    EXPECT_EQ(testing::solved(model, owner, in_mode(mode)).verdict, Verdict::unsolvable);
  }
}

TEST(Refining, LazyAsksForWhatTheSearchTouches) {
  // p0 and p1 are joined; p2 … p9 are elsewhere.
  std::string roads = "(road p0 p1) (road p1 p0)";
  for (std::size_t i = 2; i < 9; ++i) roads += "(road " + place(i) + " " + place(i + 1) + ")";
  const testing::Model model = tour(10, 1, "(at start (road ?a ?b))", roads);
  Distances distances = random_distances(10, 3);
  const Result result = testing::solved(model, distances.owner, in_mode(FunctionsMode::lazy));
  expect_sound(model, result);
  EXPECT_TRUE(distances.owner.asked_exactly.contains("(time p0 p1)"));
  EXPECT_LE(distances.owner.asked_exactly.size(), 2U);
  EXPECT_EQ(result.statistics.cheap_values, 0U);
  EXPECT_NEAR(seconds(result), distances.exact[0][1], 0.01);
}

TEST(Refining, AnOwnerWithoutBoundsIsAskedOnceForAll) {
  const testing::Model model = tour(4, 2);
  Distances distances = random_distances(4, 5);
  distances.owner.bounds.clear();
  const Result result = testing::solved(model, distances.owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  EXPECT_EQ(distances.owner.batches, 1U);
  EXPECT_EQ(result.statistics.exact_values, 16U);
}

TEST(Refining, WhatEveryPlanStandsOnIsAskedForExactlyAtOnce) {
  testing::Model model = tour(3, 1);
  model.problem = pddl::load_problem(
      "(define (problem p) (:domain d) (:objects p0 p1 p2 - place) (:init (at p0) (= (charge) 100))"
      "(:goal (and (visited p1) (<= (time p1 p2) 100))))",
      "problem.pddl", model.domain);
  Distances distances = random_distances(3, 2);
  const Result result = testing::solved(model, distances.owner, in_mode(FunctionsMode::two_accuracy));
  expect_sound(model, result);
  EXPECT_EQ(distances.owner.asked_exactly.size(), 9U);
}

TEST(Refining, AnExactValueThatDoesNotComeIsNamed) {
  const testing::Model model = tour(2, 1);
  TwoAccuracies owner;
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) owner.set(way(a, b), 30, 20);
  owner.exact["(time p0 p1)"].outcome = FunctionOutcome::late;
  const Result result = testing::solved(model, owner, in_mode(FunctionsMode::two_accuracy));
  EXPECT_EQ(result.verdict, Verdict::function_unavailable);
  EXPECT_THAT(result.reason, AllOf(HasSubstr("(time p0 p1) of module roads: late"), HasSubstr("arm_svc")));
}

TEST(Refining, ValuesThatWereNotFoundAreGoneAround) {
  for (const FunctionsMode mode : {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
    const testing::Model model = tour(3, 1);
    Distances distances = random_distances(3, 4);
    distances.owner.set(way(0, 1), FunctionOutcome::unknown);
    const Result result = testing::solved(model, distances.owner, in_mode(mode));
    expect_sound(model, result);
    EXPECT_THAT(result.plan->activities, SizeIs(2)) << to_string(mode);
  }
}

TEST(Refining, WithoutThemNothingIsProved) {
  for (const FunctionsMode mode : {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy}) {
    const testing::Model model = tour(3, 1);
    Distances distances = random_distances(3, 4);
    distances.owner.set(way(0, 1), FunctionOutcome::unknown);
    distances.owner.set(way(2, 1), FunctionOutcome::unreachable);
    distances.owner.set(way(1, 1), FunctionOutcome::unreachable);
    const Result result = testing::solved(model, distances.owner, in_mode(mode));
    EXPECT_EQ(result.verdict, Verdict::timeout) << to_string(mode);
    EXPECT_THAT(result.reason,
                AllOf(HasSubstr("not known: arm_svc found no way for (time p0 p1) with the effort spent"),
                      HasSubstr("ask again or give it more"), Not(HasSubstr("proved"))));
    EXPECT_TRUE(result.lacks_values) << to_string(mode);
    EXPECT_THAT(result.blocked, SizeIs(1)) << "the goal at p1";
    distances.owner.set(way(0, 1), FunctionOutcome::unreachable);
    const Result proved = testing::solved(model, distances.owner, in_mode(mode));
    EXPECT_EQ(proved.verdict, Verdict::unsolvable);
    EXPECT_FALSE(proved.lacks_values);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
