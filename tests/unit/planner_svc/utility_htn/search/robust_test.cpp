#include "planner_svc/utility_htn/search/robust.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
using roci::temporal::RankVector;
using search::Judgement, search::RobustOutcome, search::Toy;
using testing::ElementsAre;

// The big task fits when it takes what is predicted, and no longer with a tenth more.
Toy big_and_small() {
  Toy toy;
  toy.task("big", 10, 95, {1.0});
  toy.task("small", 10, 40, {0.6});
  toy.close();
  return toy;
}

TEST(Robust, TheWorstScoreChoosesThePlanThatHoldsWithMoreEnergy) {
  Toy toy = big_and_small();
  const RobustOutcome found = search::search_robust(toy.problem(100), {}, 1000);
  EXPECT_THAT(toy.names(found.outcome.plan), ElementsAre("small"));
  EXPECT_EQ(found.candidates[found.chosen].made_for, 1.1);
  EXPECT_EQ(found.reason,
            "the plan made for 1.1 times the predicted energy was chosen by its worst score under 1.1, 1, "
            "0.9 times "
            "that energy: 0.6");
}

TEST(Robust, TheMeanScoreMayTakeTheRisk) {
  Toy toy = big_and_small();
  const RobustOutcome found =
      search::search_robust(toy.problem(100), {{1.1, 1.0, 0.9}, Judgement::mean}, 1000);
  EXPECT_THAT(toy.names(found.outcome.plan), ElementsAre("big"));
  EXPECT_THAT(found.candidates[found.chosen].scores,
              ElementsAre(RankVector{}, RankVector{1.0}, RankVector{1.0}));
}

TEST(Robust, WhatFollowsTheEndOfTheBatteryCountsNothing) {
  Toy toy;
  toy.task("one", 10, 30, {0.5}, true);
  toy.task("two", 10, 50, {0.4}, true);
  toy.task("three", 10, 10, {0.01}, true);
  toy.close();
  const search::Problem problem = toy.problem(100);
  const search::Plan plan = search::search(problem).plan;
  ASSERT_THAT(toy.names(plan), ElementsAre("one", "two", "three"));
  EXPECT_EQ(search::score_under(problem, plan, 1.0), (RankVector{0.91}));
  EXPECT_EQ(search::score_under(problem, plan, 1.2), (RankVector{0.9}));
  EXPECT_EQ(search::score_under(problem, plan, 1.25), (RankVector{0.5}));
}

TEST(Robust, FactorsAreAboveZero) {
  Toy toy = big_and_small();
  EXPECT_THROW(search::search_robust(toy.problem(100), {{}, Judgement::worst}, 1), std::invalid_argument);
  EXPECT_THROW(search::search_robust(toy.problem(100), {{1.0, 0.0}, Judgement::worst}, 1),
               std::invalid_argument);
}

}  // namespace
