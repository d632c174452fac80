// The answering proof engine, without a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engines/lock_calls.hpp"

namespace roci::planner::proof {
namespace {

using engine::Answer, engine::BlockingGoal, engine::Request;
using temporal::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string plan_for(const Request& request) {
  const Answer answer = answer_to(request);
  EXPECT_EQ(answer.verdict, Verdict::solved) << answer.reason;
  return answer.plan ? tasks_of(*answer.plan) : "";
}

TEST(SearchEngine, LiftsTheShip) {
  EXPECT_EQ(plan_for(lock_request({goal_of("lift", {{"ship", "above"}})})),
            "open-lower, enter-below, shut-lower, fill, open-upper, leave-above");
}

TEST(SearchEngine, AnotherInitialStateGivesAnotherPlan) {
  Request request = lock_request({goal_of("lift", {{"ship", "above"}})});
  request.state["ship"] = temporal::state("inside");
  request.state["level"] = temporal::state("high");
  EXPECT_EQ(plan_for(request), "open-upper, leave-above");
}

TEST(SearchEngine, AnotherGoalGivesAnotherPlan) {
  EXPECT_EQ(plan_for(lock_request({goal_of("full", {{"level", "high"}})})), "fill");
}

TEST(SearchEngine, EachActivitySaysWhichGoalsHangOnIt) {
  const Answer answer =
      answer_to(lock_request({goal_of("in", {{"ship", "inside"}}), goal_of("full", {{"level", "high"}})}));
  ASSERT_TRUE(answer.plan) << answer.reason;
  ASSERT_EQ(tasks_of(*answer.plan), "open-lower, enter-below, shut-lower, fill");
  EXPECT_THAT(answer.plan->activities[1].goals_served, ElementsAre("ground/in"));
  EXPECT_THAT(answer.plan->activities[3].goals_served, ElementsAre("ground/full"));
}

TEST(SearchEngine, WhatNoTaskBringsAboutIsNamed) {
  const Answer answer =
      answer_to(lock_request({goal_of("lift", {{"ship", "above"}}), goal_of("flood", {{"quay", "wet"}})}));
  EXPECT_EQ(answer.verdict, Verdict::unsolvable);
  EXPECT_THAT(answer.blocking, ElementsAre(BlockingGoal{"ground", "flood", "quay", "no task makes it wet"}));
}

TEST(SearchEngine, WhatRunsOutIsNamed) {
  Request request = lock_request({goal_of("full", {{"level", "high"}})});
  request.state["energy"] = 39.0;
  const Answer answer = answer_to(request);
  ASSERT_EQ(answer.blocking.size(), 1U);
  EXPECT_EQ(answer.blocking[0].timeline, "energy");
}

TEST(SearchEngine, WhatComesTooLateIsNamed) {
  Request request = lock_request({goal_of("full", {{"level", "high"}})});
  request.goals[0].closes = request.origin + temporal::seconds(299);
  EXPECT_THAT(
      answer_to(request).blocking,
      ElementsAre(BlockingGoal{"ground", "full", "", "it cannot be achieved before its window closes"}));
  request.goals[0].closes = request.origin + temporal::seconds(300);
  EXPECT_EQ(plan_for(request), "fill");
}

TEST(SearchEngine, GoalsThatExcludeEachOtherAreNotBlamedOneByOne) {
  const Answer answer =
      answer_to(lock_request({goal_of("lift", {{"ship", "above"}}), goal_of("stay", {{"ship", "below"}})}));
  EXPECT_EQ(answer.verdict, Verdict::unsolvable);
  EXPECT_TRUE(answer.blocking.empty());
}

TEST(SearchEngine, ACancelledSearchEnds) {
  Request request = lock_request({goal_of("lift", {{"ship", "above"}})});
  engine::Limits limits;
  int polls = 0;
  limits.cancelled = [&] { return ++polls > 5; };
  engine::NoFunctions functions;
  EXPECT_EQ(engine::answer_checked(engines(), request, limits, functions).verdict, Verdict::cancelled);
}

TEST(SearchEngine, ABadModelIsToldWithItsLineAndRemedy) {
  Request request = lock_request({});
  request.model = "task fill lock_svc pumps fill 300\n  wants lower shut\n";
  const Answer answer = answer_to(request);
  EXPECT_EQ(answer.verdict, Verdict::invalid_input);
  EXPECT_THAT(answer.reason, HasSubstr("model:2: 'wants' is no word of this language; it knows task, needs"));
}

}  // namespace
}  // namespace roci::planner::proof
