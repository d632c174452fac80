// The proof engine that plans all the time, stepped by hand.
#include "tests/engines/stepped/chain_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engines/lock_calls.hpp"

namespace roci::planner::proof {
namespace {

using namespace std::chrono_literals;
using engine::BlockingGoal, engine::Goal, engine::StepInputs, engine::StepOutput;
using temporal::ActivityState, temporal::CommitState;
using ::testing::ElementsAre;

Goal heard(const std::string& kind, const std::string& id) {
  Goal goal;
  goal.issuer = "ground";
  goal.id = id;
  goal.kind = kind;
  return goal;
}

// The lock at rest; the executive takes plans.
StepInputs inputs_at(temporal::Time now, std::vector<Goal> goals) {
  StepInputs inputs;
  inputs.now = now;
  inputs.goals = std::move(goals);
  for (const auto& [timeline, value] : lock_at_rest()) inputs.observations.push_back({timeline, value, now});
  inputs.receipt.emplace();
  inputs.receipt->open = true;
  return inputs;
}

std::string tasks_of(const StepOutput& output) {
  return output.delta ? proof::tasks_of(output.delta->added) : "no change";
}

TEST(ChainEngine, PlansBackwardsFromTheGoal) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput output = engine.step(inputs_at(100s, {heard("lift", "a")}));
  EXPECT_EQ(tasks_of(output), "open-lower, enter-below, shut-lower, fill, open-upper, leave-above");
  EXPECT_EQ(output.wake, 110s) << "to commit the first, 20 s before it starts";
}

TEST(ChainEngine, CommitsTheNextOneShortlyBeforeItStarts) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput first = engine.step(inputs_at(100s, {heard("lift", "a")}));
  ASSERT_TRUE(first.delta);
  StepInputs later;
  later.now = 110s;
  later.last_version = first.delta->added.version;
  const StepOutput second = engine.step(later);
  ASSERT_TRUE(second.delta);
  EXPECT_EQ(second.delta->from_version, first.delta->added.version);
  ASSERT_EQ(tasks_of(second), "open-lower") << "it alone changes";
  EXPECT_EQ(second.delta->added.activities[0].commit, CommitState::committed);
}

TEST(ChainEngine, AGoalThatEndsTakesWhatIsLooseWithIt) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput first = engine.step(inputs_at(100s, {heard("lift", "a")}));
  StepInputs later;
  later.now = 105s;
  later.last_version = first.delta->added.version;
  later.ended_goals = {{"ground", "a", engine::GoalState::recalled}};
  const StepOutput second = engine.step(later);
  ASSERT_TRUE(second.delta);
  EXPECT_EQ(second.delta->removed_activities.size(), 6U);
}

TEST(ChainEngine, WhatBlocksAGoalIsNamed) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput output = engine.step(inputs_at(100s, {heard("flood", "quay"), heard("dance", "ship")}));
  EXPECT_EQ(tasks_of(output), "no change");
  EXPECT_THAT(output.blocking,
              ElementsAre(BlockingGoal{"ground", "quay", "quay", "no task makes it wet"},
                          BlockingGoal{"ground", "ship", "", "the model has no goal of kind 'dance'"}));
}

TEST(ChainEngine, WhatRunsOutIsNamed) {
  ChainEngine engine({"chain", "", kLockModel});
  StepInputs inputs = inputs_at(100s, {heard("lift", "a")});
  inputs.observations.push_back({"energy", 39.0, 100s});
  EXPECT_THAT(engine.step(inputs).blocking,
              ElementsAre(BlockingGoal{"ground", "a", "energy", "there is too little of it"}));
}

TEST(ChainEngine, AfterAFailureTheRestIsPlannedFromWhatIsObserved) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput first = engine.step(inputs_at(100s, {heard("lift", "a")}));
  StepInputs fails;
  fails.last_version = first.delta->added.version;
  const std::string& opened = first.delta->added.activities[0].id;
  fails.now = 130s;
  fails.steps = {{1, opened, {ActivityState::running, 130s, {}}, ""}};
  fails.last_version = 2;
  engine.step(fails);
  fails.now = 140s;
  fails.steps = {{1, opened, {ActivityState::failed, 130s, 140s}, "stuck"}};
  fails.last_version = 3;
  const StepOutput repaired = engine.step(fails);
  ASSERT_TRUE(repaired.delta);
  EXPECT_EQ(tasks_of(repaired), "open-lower, enter-below, shut-lower, fill, open-upper, leave-above");
  EXPECT_EQ(repaired.delta->removed_activities.size(), 5U) << "all but the one that failed";
}

TEST(ChainEngine, WithoutNewsNothingChanges) {
  ChainEngine engine({"chain", "", kLockModel});
  const StepOutput first = engine.step(inputs_at(100s, {heard("lift", "a"), heard("flood", "quay")}));
  StepInputs later;
  later.last_version = first.delta->added.version;
  for (later.now = 101s; later.now < 110s; later.now += 1s) {
    later.observations = {{"level", temporal::state("low"), later.now}};
    EXPECT_EQ(tasks_of(engine.step(later)), "no change");
  }
}

}  // namespace
}  // namespace roci::planner::proof
