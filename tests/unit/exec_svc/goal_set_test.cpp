#include "exec_svc/goals/goal_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {

using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalSet;
using goals::GoalState;
using mission::MissionModel;

namespace {

using temporal::seconds;
using ::testing::HasSubstr;
using testing::photo;

class GoalSetTest : public ::testing::Test {
 protected:
  std::string fault(const GoalRequest& goal) {
    const auto [taken, record] = goals.submit(goal, seconds(100));
    return taken == GoalSet::Disposition::known      ? "nothing changed"
           : taken == GoalSet::Disposition::rejected ? record->reason
                                                     : "accepted";
  }
  MissionModel mission = testing::planetary();
  GoalSet goals{mission};
};

TEST_F(GoalSetTest, AcceptsAndRepeatsNothing) {
  EXPECT_EQ(fault(photo("a")), "accepted");
  EXPECT_EQ(fault(photo("a")), "nothing changed");
  ASSERT_EQ(goals.open().size(), 1U);
}

// A journal that was damaged, or a mission that has changed since.
TEST_F(GoalSetTest, AGoalOfTheJournalThatTheMissionCannotHaveIsRejectedAndTheOthersStay) {
  GoalRecord record;
  record.state = GoalState::pending;
  record.request = photo("a");
  goals.restore(record);
  record.request = photo("b");
  record.request.kind = "phovo";
  goals.restore(record);
  record.request = photo("c");
  record.request.arguments.erase("x");
  goals.restore(record);
  ASSERT_EQ(goals.present().size(), 1U);
  EXPECT_EQ(goals.present().front()->request.key.id, "a");
  EXPECT_EQ(goals.find(photo("b").key)->state, GoalState::rejected);
  EXPECT_THAT(goals.find(photo("b").key)->reason, HasSubstr("unknown goal kind 'phovo'"));
  EXPECT_THAT(goals.find(photo("c").key)->reason, HasSubstr("argument 'x' is missing"));
}

TEST_F(GoalSetTest, EachSampleIsAnsweredOnce) {
  GoalRequest goal = photo("a");
  const auto say = [&](std::uint64_t number) {
    goal.sample = {"roci-7", 0, number};
    const auto [taken, record] = goals.submit(goal, seconds(100));
    EXPECT_EQ(record->answers, goal.sample);
    return taken;
  };
  using Disposition = GoalSet::Disposition;
  EXPECT_EQ(say(1), Disposition::accepted);
  EXPECT_EQ(say(1), Disposition::known);
  EXPECT_EQ(say(2), Disposition::repeated);
  goal.arguments["x"] = "far";
  EXPECT_EQ(say(3), Disposition::refused);
  goal.arguments["x"] = "50";
  EXPECT_EQ(say(4), Disposition::accepted);
  goals.set_state(goal.key, GoalState::achieved, "observed");
  EXPECT_EQ(goals.find(goal.key)->answers.number, 4U);
  goal.recalled = true;
  EXPECT_EQ(say(5), Disposition::repeated) << "too late";
  EXPECT_EQ(goals.find(goal.key)->state, GoalState::achieved);
}

// Who joins anew hears the newest sample of each sender, also of one that came before what another one has said since.
TEST_F(GoalSetTest, WhatWasSaidBeforeIsNoNewWish) {
  using Disposition = GoalSet::Disposition;
  const auto say = [&](const std::string& sender, std::uint32_t incarnation, std::uint64_t number,
                       bool recalled, const char* x = "50") {
    GoalRequest goal = photo("a");
    goal.arguments["x"] = x;
    goal.recalled = recalled;
    goal.sample = {sender, incarnation, number};
    return goals.submit(goal, seconds(100)).taken;
  };
  EXPECT_EQ(say("sim_svc", 1, 3, false), Disposition::accepted);
  EXPECT_EQ(say("roci-7", 0, 1, false, "60"), Disposition::accepted) << "a change";
  EXPECT_EQ(say("sim_svc", 1, 3, false), Disposition::known);
  EXPECT_EQ(say("roci-8", 0, 1, true, "60"), Disposition::recalled);
  EXPECT_EQ(say("sim_svc", 1, 3, false), Disposition::known);
  EXPECT_EQ(say("roci-7", 0, 1, false, "60"), Disposition::known);
  const auto* record = goals.find(photo("a").key);
  EXPECT_EQ(record->state, GoalState::recalled);
  EXPECT_EQ(record->answers.sender, "roci-8");
  EXPECT_EQ(say("roci-7", 0, 2, false, "60"), Disposition::accepted) << "said anew";
}

// A service that died says what it said before in its next incarnation.
TEST_F(GoalSetTest, WhatAServiceSaysAgainAfterItsDeathIsNoNewWish) {
  using Disposition = GoalSet::Disposition;
  GoalRequest goal = photo("a");
  goal.sample = {"sim_svc", 1, 3};
  goals.submit(goal, seconds(100));
  GoalRequest recall = goal;
  recall.recalled = true;
  recall.sample = {"roci-8", 0, 1};
  goals.submit(recall, seconds(100));
  goal.sample = {"sim_svc", 2, 1};
  EXPECT_EQ(goals.submit(goal, seconds(100)).taken, Disposition::known);
  EXPECT_EQ(goals.find(goal.key)->state, GoalState::recalled);
  goal.arguments["x"] = "60";
  goal.sample.number = 2;
  EXPECT_EQ(goals.submit(goal, seconds(100)).taken, Disposition::accepted) << "another wish";
}

TEST_F(GoalSetTest, OfWhatWasSaidBeforeTheNewestAreKept) {
  GoalRequest goal = photo("a");
  for (std::uint64_t i = 1; i <= 40; ++i) {
    goal.sample = {"roci-" + std::to_string(i), 0, 1};
    goals.submit(goal, seconds(100));
  }
  const auto& before = goals.find(goal.key)->before;
  ASSERT_EQ(before.size(), 16U);
  EXPECT_EQ(before.back().sender, "roci-39");
}

TEST_F(GoalSetTest, AGoalDoesNotNameItself) {
  GoalRequest drop = photo("depot");
  drop.kind = "drop_sample";
  drop.arguments["sample"] = "depot";
  EXPECT_THAT(fault(drop), HasSubstr("names goal 'depot', which is not known"));
}

TEST_F(GoalSetTest, RejectsWithAReasonThatNamesTheRemedy) {
  GoalRequest goal = photo("a");
  goal.kind = "photograph";
  EXPECT_THAT(
      fault(goal),
      HasSubstr("unknown goal kind 'photograph'; this mission knows: drop_sample, photo, pick_sample"));
  goal = photo("b");
  goal.arguments["x"] = "far";
  EXPECT_THAT(fault(goal), HasSubstr("argument 'x' is 'far'; expected a number"));
  goal = photo("c");
  goal.arguments.erase("y");
  EXPECT_THAT(fault(goal), HasSubstr("argument 'y' is missing"));
  goal = photo("d");
  goal.arguments["z"] = "1";
  EXPECT_THAT(fault(goal), HasSubstr("unknown argument 'z'"));
  EXPECT_THAT(fault(photo("Has Space")), HasSubstr("is not a name"));
  goal = photo("e");
  goal.opens = seconds(50);
  goal.closes = seconds(90);
  EXPECT_THAT(fault(goal), HasSubstr("has passed"));
  goal = photo("f");
  goal.kind = "drop_sample";
  goal.arguments["sample"] = "nowhere";
  EXPECT_THAT(fault(goal), HasSubstr("names goal 'nowhere', which is not known"));
  goal = photo("g");
  goal.kind = "pick_sample";
  goal.closes = seconds(9000);
  EXPECT_THAT(fault(goal), HasSubstr("a pick_sample knows no window; leave 'opens' and 'closes' out, or give "
                                     "goal kind 'pick_sample' a 'window' in mission.yaml"));
  std::swap(goal.opens, goal.closes);
  EXPECT_THAT(fault(goal), HasSubstr("a pick_sample knows no window"));
  EXPECT_TRUE(goals.open().empty());
}

TEST_F(GoalSetTest, AnArgumentThatNamesAGoalNeedsThatGoalsObjects) {
  GoalRequest pick = photo("soil");
  pick.kind = "pick_sample";
  GoalRequest drop = photo("depot");
  drop.kind = "drop_sample";
  drop.arguments["sample"] = "ridge";
  fault(photo("ridge"));
  EXPECT_THAT(fault(drop),
              HasSubstr("names goal 'ridge', a photo without an object 'sample-ridge'; name a goal "
                        "of kind: pick_sample"));
  fault(pick);
  drop.arguments["sample"] = "soil";
  EXPECT_EQ(fault(drop), "accepted");
}

TEST_F(GoalSetTest, AGoalKeepsItsKind) {
  fault(photo("a"));
  GoalRequest changed = photo("a");
  changed.kind = "pick_sample";
  const GoalRecord* record = goals.submit(changed, seconds(100)).record;
  EXPECT_EQ(record->state, GoalState::pending);
  EXPECT_EQ(record->request, photo("a"));
  EXPECT_THAT(record->reason, HasSubstr("it is a photo and stays one; choose another id"));
}

TEST_F(GoalSetTest, AUtilityIsANumber) {
  EXPECT_THAT(fault(photo("a", GoalClass::optional, std::nan(""))), HasSubstr("finite"));
}

TEST_F(GoalSetTest, TwoIssuersCannotShareAnId) {
  EXPECT_EQ(fault(photo("a")), "accepted");
  GoalRequest other = photo("a");
  other.key.issuer = "science_svc";
  EXPECT_THAT(fault(other), HasSubstr("in use by issuer 'ground'"));
}

TEST_F(GoalSetTest, RecallEndsAGoalAndChangeReopensIt) {
  fault(photo("a"));
  GoalRequest recall = photo("a");
  recall.recalled = true;
  EXPECT_EQ(goals.submit(recall, seconds(200)).record->state, GoalState::recalled);
  EXPECT_TRUE(goals.open().empty());
  GoalRequest changed = photo("a");
  changed.arguments["x"] = "50";
  EXPECT_EQ(goals.submit(changed, seconds(300)).record->state, GoalState::pending);
}

TEST_F(GoalSetTest, DropsNewestOpportunisticThenOptionalOfLowestUtilityNeverHard) {
  fault(photo("hard"));
  fault(photo("opt-2", GoalClass::optional, 2));
  fault(photo("opt-1", GoalClass::optional, 1));
  fault(photo("opt-3", GoalClass::optional, 3));
  fault(photo("old", GoalClass::opportunistic, 1));
  fault(photo("new", GoalClass::opportunistic, 9));
  std::vector<std::string> order;
  while (const auto victim = goals.drop_candidate()) {
    order.push_back(victim->id);
    goals.set_state(*victim, GoalState::dropped, "test");
  }
  EXPECT_THAT(order, ::testing::ElementsAre("new", "old", "opt-1", "opt-2", "opt-3"));
  EXPECT_EQ(goals.open().front()->request.key.id, "hard");
}

TEST_F(GoalSetTest, OfGoalsWorthTheSameTheLowestPriorityLeavesFirst) {
  const auto submit = [this](const std::string& id, GoalClass importance, double utility, int priority) {
    GoalRequest goal = photo(id, importance, utility);
    goal.priority = priority;
    EXPECT_EQ(fault(goal), "accepted");
  };
  submit("low", GoalClass::opportunistic, 9, -1);
  submit("old", GoalClass::opportunistic, 1, 0);
  submit("new", GoalClass::opportunistic, 1, 0);
  submit("opt-low", GoalClass::optional, 2, 1);
  submit("opt-high", GoalClass::optional, 2, 5);
  submit("opt-cheap", GoalClass::optional, 1, 9);
  std::vector<std::string> order;
  while (const auto victim = goals.drop_candidate()) {
    order.push_back(victim->id);
    goals.set_state(*victim, GoalState::dropped, "test");
  }
  EXPECT_THAT(order, ::testing::ElementsAre("low", "new", "old", "opt-cheap", "opt-low", "opt-high"));
}

// Any gain of a higher rank outweighs every gain of the lower ones.
TEST_F(GoalSetTest, UtilitiesAreComparedByRank) {
  const auto submit = [this](const std::string& id, temporal::RankVector utility) {
    GoalRequest goal = photo(id, GoalClass::optional);
    goal.utility = std::move(utility);
    EXPECT_EQ(fault(goal), "accepted");
  };
  submit("science", {0, 100});
  submit("safety", {1});
  submit("both", {1, 2});
  submit("neither", {0, 99, 7});
  std::vector<std::string> order;
  while (const auto victim = goals.drop_candidate()) {
    order.push_back(victim->id);
    goals.set_state(*victim, GoalState::dropped, "test");
  }
  EXPECT_THAT(order, ::testing::ElementsAre("neither", "science", "safety", "both"));
  EXPECT_THAT(fault([] {
                GoalRequest goal = photo("none", GoalClass::optional);
                goal.utility = temporal::RankVector(std::vector<double>{1, std::nan("")});
                return goal;
              }()),
              HasSubstr("finite"));
}

TEST_F(GoalSetTest, AGoalComesAfterTheOnesThatItNames) {
  GoalRequest depot = photo("depot");
  depot.kind = "drop_sample";
  depot.arguments["sample"] = "soil";
  const auto order = [this](const std::vector<GoalRequest>& requests) {
    std::string out;
    for (const GoalRequest& one : goals.in_reference_order(requests)) out += one.key.id + " ";
    return out;
  };
  EXPECT_EQ(order({depot, photo("ridge"), photo("soil")}), "ridge soil depot ");
  EXPECT_EQ(order({photo("soil"), depot, photo("ridge")}), "soil depot ridge ") << "as they came";
  depot.arguments["sample"] = "depot";
  EXPECT_EQ(order({depot, photo("ridge")}), "depot ridge ");
}

}  // namespace
}  // namespace roci::exec
