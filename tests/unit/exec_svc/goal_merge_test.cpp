// Two records of a goal, of executives that led apart, become one.
#include "exec_svc/goals/goal_merge.hpp"

#include <gtest/gtest.h>

namespace roci::exec::goals {
namespace {

GoalRecord goal(GoalState state, std::uint32_t revision = 0, std::int32_t priority = 0) {
  GoalRecord out;
  out.request.key = {"ground", "rock"};
  out.request.kind = "photo";
  out.request.priority = priority;
  out.state = state;
  out.revision = revision;
  return out;
}

GoalRecord recalled(std::uint32_t revision = 1) {
  GoalRecord out = goal(GoalState::recalled, revision);
  out.request.recalled = true;
  return out;
}

GoalState state_of(const std::optional<GoalRecord>& record) {
  return record ? record->state : GoalState::rejected;
}

TEST(GoalMerge, TheSameChangesNothing) {
  EXPECT_FALSE(merged(goal(GoalState::pending), goal(GoalState::pending)));
  EXPECT_FALSE(merged(goal(GoalState::planned), goal(GoalState::pending)));
  EXPECT_FALSE(merged(recalled(), goal(GoalState::planned)));
}

TEST(GoalMerge, ARecallBeatsAllButAnAchievedGoal) {
  for (const GoalState state :
       {GoalState::pending, GoalState::planned, GoalState::failed, GoalState::dropped}) {
    const auto both = merged(goal(state), recalled());
    ASSERT_TRUE(both);
    EXPECT_EQ(both->state, GoalState::recalled);
    EXPECT_TRUE(both->request.recalled);
  }
  const auto changed = merged(goal(GoalState::planned, 5, 3), recalled());
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->state, GoalState::recalled) << "also a changed one";
  EXPECT_EQ(state_of(merged(goal(GoalState::achieved), recalled())), GoalState::achieved);
  EXPECT_EQ(state_of(merged(recalled(), goal(GoalState::achieved))), GoalState::achieved);
}

// Who gave the goal says it again to an executive that leads anew; that is older than the recall.
TEST(GoalMerge, WhatWasSaidBeforeARecallStaysKnown) {
  GoalRecord ours = goal(GoalState::planned);
  ours.request.sample = ours.answers = {"sim_svc", 1, 3};
  GoalRecord theirs = recalled();
  theirs.answers = {"roci-7", 0, 1};
  theirs.before = {{"roci-6", 0, 9}};
  const auto both = merged(ours, theirs);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->answers, theirs.answers);
  EXPECT_EQ(both->before, (std::vector<SampleId>{{"roci-6", 0, 9}, {"sim_svc", 1, 3}}));
}

TEST(GoalMerge, WhatTheOtherAchievedIsAchieved) {
  EXPECT_EQ(state_of(merged(goal(GoalState::planned), goal(GoalState::achieved))), GoalState::achieved);
  EXPECT_FALSE(merged(goal(GoalState::achieved), goal(GoalState::pending)));
}

TEST(GoalMerge, AGoalThatTheOtherGaveUpStaysOpen) {
  EXPECT_FALSE(merged(goal(GoalState::pending), goal(GoalState::failed)));
  EXPECT_FALSE(merged(goal(GoalState::pending), goal(GoalState::dropped)));
}

TEST(GoalMerge, OfTwoWishesTheOneWithMoreChangesCounts) {
  const auto theirs = merged(goal(GoalState::planned, 1, 1), goal(GoalState::planned, 2, 2));
  ASSERT_TRUE(theirs);
  EXPECT_EQ(theirs->request.priority, 2);
  EXPECT_EQ(theirs->state, GoalState::pending) << "it is in no plan of ours";
  EXPECT_EQ(theirs->revision, 2U);
  EXPECT_FALSE(merged(goal(GoalState::planned, 2, 1), goal(GoalState::planned, 2, 2)));
  EXPECT_FALSE(merged(goal(GoalState::planned, 3, 1), goal(GoalState::planned, 2, 2)));
  EXPECT_EQ(state_of(merged(goal(GoalState::achieved, 1, 1), goal(GoalState::pending, 2, 2))),
            GoalState::pending)
      << "it was wanted anew";
}

TEST(GoalMerge, WhatWasRejectedCountsForNothing) {
  EXPECT_FALSE(merged(goal(GoalState::pending), goal(GoalState::rejected, 7)));
  EXPECT_EQ(state_of(merged(goal(GoalState::rejected), goal(GoalState::planned))), GoalState::pending);
}

// Whoever is merged into whom, and however often, nothing more changes.
TEST(GoalMerge, IsDoneAfterOnce) {
  const std::vector<GoalRecord> all{goal(GoalState::pending),      goal(GoalState::planned, 2, 5),
                                    goal(GoalState::achieved),     goal(GoalState::failed, 1, 2),
                                    goal(GoalState::rejected),     recalled(),
                                    goal(GoalState::dropped, 3, 1)};
  for (const GoalRecord& ours : all) {
    for (const GoalRecord& theirs : all) {
      const auto once = merged(ours, theirs);
      EXPECT_FALSE(merged(once.value_or(ours), theirs));
    }
  }
}

}  // namespace
}  // namespace roci::exec::goals
