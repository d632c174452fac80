// How often the operators of a relaxed plan are needed where numbers are used up, computed by hand.
#include "planner_svc/temporal_pddl/heuristics/relaxed_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using heuristics::Estimate;
using heuristics::FfHeuristic;
using heuristics::RelaxedPlan;
using task::Action;
using task::ActionId;
using task::Task;
using ::testing::UnorderedElementsAre;

// Name of the action and how often each of its ends, or it itself, is in the first relaxed plan.
std::vector<std::pair<std::string, std::int64_t>> relaxed_plan(const testing::Model& made) {
  const Task task = testing::grounded(made).task;
  FfHeuristic ff(task);
  Estimate estimate;
  ff.evaluate({task.initial_state, {}, 0, nullptr, {}, {}}, estimate);
  EXPECT_FALSE(estimate.dead_end);
  EXPECT_EQ(estimate.steps, static_cast<std::int64_t>(estimate.relaxed_plan.size()));
  std::vector<std::pair<std::string, std::int64_t>> result;
  for (std::size_t i = 0; i < task.actions.size(); ++i) {
    const Action& action = task.actions[ActionId(i)];
    const auto starts = std::ranges::count(estimate.relaxed_plan, action.start);
    EXPECT_EQ(std::ranges::count(estimate.relaxed_plan, action.end), starts);
    if (starts > 0) result.emplace_back(name(task, ActionId(i)), starts);
  }
  return result;
}

constexpr const char* kBakery = R"((:requirements :fluents)
  (:functions (flour) (bread) (cake))
  (:action grind :parameters () :precondition () :effect (increase (flour) 1))
  (:action bread :parameters () :precondition (>= (flour) 2)
    :effect (and (decrease (flour) 2) (increase (bread) 2)))
  (:action cake :parameters () :precondition (>= (flour) 1)
    :effect (and (decrease (flour) 1) (increase (cake) 1))))";

TEST(RelaxedPlan, AProducerIsRepeatedForAllThatTakeOfANumber) {
  const auto made = testing::model(
      kBakery, "(:init (= (flour) 1) (= (bread) 0) (= (cake) 0)) (:goal (and (>= (bread) 4) (>= (cake) 3)))");
  // 2 × 2 for the bread and 3 for the cake, of which there is 1
  EXPECT_THAT(relaxed_plan(made),
              UnorderedElementsAre(std::pair{"(grind)", 6}, std::pair{"(bread)", 2}, std::pair{"(cake)", 3}));
}

TEST(RelaxedPlan, WhatIsThereIsUsedFirst) {
  const auto made =
      testing::model(kBakery, "(:init (= (flour) 9) (= (bread) 3) (= (cake) 0)) (:goal (>= (bread) 5))");
  EXPECT_THAT(relaxed_plan(made), UnorderedElementsAre(std::pair{"(bread)", 1}));
}

TEST(RelaxedPlan, AGoalThatHoldsIsRestoredIfSomethingTakesOfIt) {
  const auto made = testing::model(
      kBakery,
      "(:init (= (flour) 2) (= (bread) 0) (= (cake) 0)) (:goal (and (>= (bread) 1) (>= (flour) 2)))");
  EXPECT_THAT(relaxed_plan(made), UnorderedElementsAre(std::pair{"(grind)", 2}, std::pair{"(bread)", 1}));
}

// A catalyst comes back: it is made once, and what gives it back is no way to make it.
TEST(RelaxedPlan, WhatComesBackIsNotUsedUp) {
  const auto made = testing::model(R"((:requirements :fluents :durative-actions)
    (:functions (catalyst) (product))
    (:durative-action make :parameters () :duration (= ?duration 9) :condition ()
      :effect (at end (increase (catalyst) 1)))
    (:durative-action react :parameters () :duration (= ?duration 1)
      :condition (at start (>= (catalyst) 2))
      :effect (and (at start (decrease (catalyst) 2)) (at end (increase (catalyst) 2))
                   (at end (increase (product) 1)))))",
                                   "(:init (= (catalyst) 0) (= (product) 0)) (:goal (>= (product) 5))");
  EXPECT_THAT(relaxed_plan(made), UnorderedElementsAre(std::pair{"(make)", 2}, std::pair{"(react)", 5}));
}

// Each of the two is made of the other: a little more of both with each exchange.
TEST(RelaxedPlan, ComesToAnEndWhereNumbersHangOnEachOther) {
  const auto made = testing::model(R"((:requirements :fluents)
    (:functions (a) (b))
    (:action to-a :parameters () :precondition (>= (b) 2) :effect (and (decrease (b) 2) (increase (a) 3)))
    (:action to-b :parameters () :precondition (>= (a) 2) :effect (and (decrease (a) 2) (increase (b) 3))))",
                                   "(:init (= (a) 2) (= (b) 0)) (:goal (and (>= (a) 6) (>= (b) 6)))");
  EXPECT_FALSE(relaxed_plan(made).empty());
  testing::expect_valid(made, testing::solved(made));
}

// Three products that compete for what two of them are made of.
TEST(RelaxedPlan, SolvesWhatCompetesForNumbersByBeingFollowed) {
  const auto made = testing::model(kBakery,
                                   "(:init (= (flour) 0) (= (bread) 0) (= (cake) 0))"
                                   "(:goal (and (>= (bread) 20) (>= (cake) 15) (>= (flour) 7)))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  EXPECT_LE(result.statistics.evaluated, 2u);
}

// What holds only while something else does is needed twice, by (bake) for longer than (low) can give.
TEST(RelaxedPlan, OneEnvelopeIsTakenForAllThatItCanHold) {
  const auto made = testing::model(R"((:requirements :durative-actions)
    (:predicates (hot) (dried) (baked))
    (:durative-action low :parameters () :duration (= ?duration 4) :condition ()
      :effect (and (at start (hot)) (at end (not (hot)))))
    (:durative-action high :parameters () :duration (= ?duration 9) :condition ()
      :effect (and (at start (hot)) (at end (not (hot)))))
    (:durative-action dry :parameters () :duration (= ?duration 2) :condition (over all (hot))
      :effect (at end (dried)))
    (:durative-action bake :parameters () :duration (= ?duration 6) :condition (over all (hot))
      :effect (at end (baked))))",
                                   "(:init) (:goal (and (dried) (baked)))");
  EXPECT_THAT(relaxed_plan(made),
              UnorderedElementsAre(std::pair{"(high)", 1}, std::pair{"(dry)", 1}, std::pair{"(bake)", 1}));
}

// One long action makes it ready, or two short ones; (close) may come too late.
TEST(RelaxedPlan, WhereTimeCountsWhatComesSoonestIsTaken) {
  const char* domain = R"((:requirements :durative-actions :timed-initial-literals)
    (:predicates (open) (half) (ready) (closed))
    (:durative-action slow :parameters () :duration (= ?duration 50) :condition () :effect (at end (ready)))
    (:durative-action first :parameters () :duration (= ?duration 5) :condition () :effect (at end (half)))
    (:durative-action second :parameters () :duration (= ?duration 5) :condition (at start (half))
      :effect (at end (ready)))
    (:durative-action close :parameters () :duration (= ?duration 1)
      :condition (and (at start (ready)) (over all (open))) :effect (at end (closed))))";
  EXPECT_THAT(relaxed_plan(testing::model(domain, "(:init (open)) (:goal (closed))")),
              UnorderedElementsAre(std::pair{"(slow)", 1}, std::pair{"(close)", 1}));
  EXPECT_THAT(
      relaxed_plan(testing::model(domain, "(:init (open) (at 60 (not (open)))) (:goal (closed))")),
      UnorderedElementsAre(std::pair{"(first)", 1}, std::pair{"(second)", 1}, std::pair{"(close)", 1}));
}

// Ten pictures and three cameras, one of which is warm already, and no time for one to take more than four.
TEST(RelaxedPlan, WorkIsSharedOutInTimeForADeadline) {
  std::string objects = "(:objects c0 c1 c2 - camera", init = "(:init (open) (at 60 (not (open))) (warm c0)",
              goal;
  for (int i = 0; i < 10; ++i) {
    objects += " p" + std::to_string(i) + " - picture";
    goal += " (sent p" + std::to_string(i) + ")";
  }
  for (int i = 0; i < 3; ++i) init += " (free c" + std::to_string(i) + ")";
  const auto made = testing::model(R"((:requirements :typing :durative-actions :timed-initial-literals)
    (:types camera picture)
    (:predicates (open) (free ?c - camera) (warm ?c - camera) (taken ?p - picture) (sent ?p - picture))
    (:durative-action heat :parameters (?c - camera) :duration (= ?duration 9)
      :condition (at start (free ?c))
      :effect (and (at start (not (free ?c))) (at end (free ?c)) (at end (warm ?c))))
    (:durative-action take :parameters (?c - camera ?p - picture) :duration (= ?duration 12)
      :condition (and (at start (free ?c)) (over all (warm ?c)))
      :effect (and (at start (not (free ?c))) (at end (free ?c)) (at end (taken ?p))))
    (:durative-action send :parameters (?p - picture) :duration (= ?duration 1)
      :condition (and (at start (taken ?p)) (over all (open))) :effect (at end (sent ?p))))",
                                   objects + ")" + init + ") (:goal (and" + goal + "))");
  const Result result = testing::solved(made);
  testing::expect_valid(made, result);
  EXPECT_LE(result.statistics.evaluated, 200u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
