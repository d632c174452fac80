// Good and bad goals sent to a flying mission, with every real service: each bad one is refused or given up
// with its reason, alone; the mission goes on and nothing is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/scenario/mission_in_process.hpp"

namespace roci::scenario {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::pair<std::string, std::string>> kFreeGround{{"x", "110"}, {"y", "100"}};
const std::vector<std::pair<std::string, std::string>> kInARock{{"x", "60"}, {"y", "220"}};
const std::vector<std::pair<std::string, std::string>> kOutside{{"x", "1000"}, {"y", "60"}};
const std::vector<std::pair<std::string, std::string>> kCrater{{"x", "190"}, {"y", "60"}};

// The three goals of the scenario.
void expect_uploaded_goals_achieved(const MissionInProcess& mission) {
  for (const char* id : {"ridge", "soil", "depot"}) {
    ASSERT_TRUE(mission.goals().contains(id));
    EXPECT_EQ(mission.goal(id).states.back(), v1::GOAL_ACHIEVED) << id << ": " << mission.goal(id).reason;
  }
}

TEST(Goals, AGoodOneIsAddedToTheRunningMission) {
  MissionInProcess mission;
  mission.send(600s, goal("more", "photo", kFreeGround));
  mission.run();
  EXPECT_THAT(mission.goal("more").states,
              ElementsAre(v1::GOAL_PENDING, v1::GOAL_PLANNED, v1::GOAL_ACHIEVED));
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.mission().outcome(), "achieved");
}

// R76: PDDL says (battery) and (comm-window), owners observe rover.battery and comm.window. The plan that others hear
// speaks of the latter, so that its projection starts at what was observed.
TEST(Goals, ThePlanForOthersNamesWhatIsObserved) {
  MissionInProcess mission;
  mission.run();
  ASSERT_FALSE(mission.plans().empty());
  std::set<std::string> changed, asked;
  for (const v1::PlanActivity& activity : mission.plans().front().activities()) {
    for (const v1::Impact& impact : activity.impacts()) changed.insert(impact.timeline());
    for (const v1::ConditionNode& node : activity.pre().nodes()) asked.insert(node.timeline());
  }
  EXPECT_THAT(changed, AllOf(Contains("rover.battery"), Not(Contains("(battery)"))));
  EXPECT_THAT(asked, AllOf(Contains("rover.battery"), Not(Contains("(battery)"))));
}

// The first call is made at 10 s and would take more than half a second.
TEST(Goals, AGoodOneThatComesDuringAPlannerCallEndsTheCallAndOneMoreFollows) {
  MissionInProcess mission;
  mission.send(10200ms, goal("more", "photo", kFreeGround));
  mission.run();
  ASSERT_EQ(mission.calls().size(), 2U);
  EXPECT_EQ(mission.calls()[0].header().stamp_us(), 10'000'000);
  EXPECT_EQ(mission.calls()[1].header().stamp_us(), 10'200'000);
  EXPECT_THAT(mission.events(), Contains(HasSubstr("planner call 1 is cancelled: goal ground/more arrived")));
  EXPECT_EQ(mission.plans().size(), 1U);
  EXPECT_EQ(mission.goal("more").states.back(), v1::GOAL_ACHIEVED);
  expect_uploaded_goals_achieved(mission);
}

TEST(Goals, AHardOneThatCannotBeReachedFailsAlone) {
  for (const auto& place : {kInARock, kOutside, kCrater}) {
    MissionInProcess mission;
    mission.send(600s, goal("soft", "photo", kFreeGround, v1::GOAL_OPTIONAL, 1));
    mission.send(700s, goal("bad", "photo", place));
    mission.run();
    EXPECT_EQ(mission.goal("bad").states.back(), v1::GOAL_FAILED);
    EXPECT_THAT(mission.goal("bad").reason, HasSubstr("sent image-bad"));
    EXPECT_EQ(mission.goal("soft").states.back(), v1::GOAL_ACHIEVED) << mission.goal("soft").reason;
    expect_uploaded_goals_achieved(mission);
    EXPECT_EQ(mission.mission().outcome(), "partial");
  }
}

TEST(Goals, AnOptionalOneThatCannotBeReachedIsDroppedAlone) {
  MissionInProcess mission;
  mission.send(600s, goal("good", "photo", kFreeGround, v1::GOAL_OPTIONAL, 1));
  mission.send(600s, goal("bad", "photo", kInARock, v1::GOAL_OPTIONAL, 5));
  mission.run();
  EXPECT_EQ(mission.goal("bad").states.back(), v1::GOAL_DROPPED);
  EXPECT_EQ(mission.goal("good").states.back(), v1::GOAL_ACHIEVED) << mission.goal("good").reason;
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.mission().outcome(), "achieved");
}

// What the planner knows of the place is told in words of the mission, and the planner's own words come behind.
TEST(Goals, OneThatIsGivenUpSaysTheTrueReason) {
  MissionInProcess mission;
  mission.send(600s, goal("steep", "photo", kCrater, v1::GOAL_OPTIONAL, 1));
  mission.send(600s, goal("outside", "photo", kOutside, v1::GOAL_OPTIONAL, 1));
  mission.run();
  EXPECT_THAT(
      mission.events(),
      Contains(AllOf(
          HasSubstr("goal.dropped goal ground/outside dropped: out of reach: place-outside (x=1000 y=60): "
                    "the place lies outside the map"),
          HasSubstr("(says pathplan_svc, model 1)"))));
  EXPECT_THAT(mission.goal("steep").reason, HasSubstr("place-steep (x=190 y=60)"));
  EXPECT_THAT(mission.goal("steep").reason, HasSubstr("\ndetails: "));
  for (const std::string& event : mission.events()) {
    if (event.find("goal.dropped ") == std::string::npos) continue;
    EXPECT_THAT(event, HasSubstr(": out of reach: "));
  }
}

// The domain derives "archived" from "sent"; no observation stands for it by itself.
TEST(Goals, OneOnADerivedPredicateIsSeenAsAchieved) {
  std::string domain = planetary_file("domain.pddl", ":typing", ":typing :derived-predicates");
  const std::string functions = "  (:functions (battery)";
  domain.replace(domain.find("(comm-window))"), 14, "(comm-window) (archived ?i - image))");
  domain.insert(domain.find(functions), "  (:derived (archived ?i - image) (sent ?i))\n\n");
  MissionInProcess mission(
      {{"domain.pddl", domain},
       {"mission.yaml", planetary_file("mission.yaml", "(sent image-{id})", "(archived image-{id})")}});
  mission.run();
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.mission().outcome(), "achieved");
  EXPECT_EQ(mission.plans().size(), 1U);
}

TEST(Goals, OneThatIsAnAlternativeANegationAndANumberIsPlannedAndSeenAsAchieved) {
  MissionInProcess mission(
      {{"mission.yaml", planetary_file("mission.yaml", "goal: [\"(sent image-{id})\"]",
                                       "goal: [\"(or (sent image-{id}) (have-image image-{id}))\", "
                                       "\"(not (at here))\", \"(<= (battery) 890000)\"]")}});
  mission.run();
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.plans().size(), 1U);
}

// An image may only be taken once the battery is below a bound,
// which the drive there brings about: legal, and one plan.
TEST(Goals, AnUpperBoundThatARunningDriveWillSatisfyBreaksNothing) {
  const std::string reserve = "(at start (>= (battery) (+ (reserve) 1160)))";
  MissionInProcess mission({{"domain.pddl", planetary_file("domain.pddl", reserve,
                                                           reserve + " (at start (<= (battery) 885000))")}});
  mission.run();
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.plans().size(), 1U);
}

TEST(Goals, MalformedOnesAreRejectedWithTheRemedyAndChangeNothing) {
  MissionInProcess mission;
  v1::Goal twin = goal("ridge", "photo", kFreeGround);
  twin.issuer("somebody");
  mission.send(600s, goal("kind", "photograph", kFreeGround));
  mission.send(601s, goal("Name Of Its Own", "photo", kFreeGround));
  mission.send(602s, goal("number", "photo", {{"x", "far"}, {"y", "1"}}));
  mission.send(603s, goal("missing", "photo", {{"x", "1"}}));
  mission.send(604s, goal("extra", "photo", {{"x", "1"}, {"y", "1"}, {"z", "1"}}));
  mission.send(605s, goal("stranger", "drop_sample", {{"x", "70"}, {"y", "140"}, {"sample", "nobody"}}));
  mission.send(606s, goal("no-sample", "drop_sample", {{"x", "70"}, {"y", "140"}, {"sample", "ridge"}}));
  v1::Goal worthless = goal("worthless", "photo", kFreeGround, v1::GOAL_OPTIONAL, std::nan(""));
  mission.send(607s, worthless);
  mission.send(608s, goal("bytes", "\xff\xfe", kFreeGround));
  mission.run();
  const auto expect_rejected = [&](const std::string& id, const std::string& why) {
    EXPECT_THAT(mission.goal(id).states, ElementsAre(v1::GOAL_REJECTED)) << id;
    EXPECT_THAT(mission.goal(id).reason, HasSubstr(why));
  };
  expect_rejected("kind", "this mission knows: drop_sample, photo, pick_sample");
  expect_rejected("Name Of Its Own", "use lower-case letters");
  expect_rejected("number", "'x' is 'far'; expected a number");
  expect_rejected("missing", "a photo needs: x, y");
  expect_rejected("extra", "a photo takes: x, y");
  expect_rejected("stranger", "send that goal first");
  expect_rejected("no-sample", "name a goal of kind: pick_sample");
  expect_rejected("worthless", "utility is not a finite number");
  expect_rejected("bytes", "unknown goal kind");
  EXPECT_THAT(mission.events(), Not(Contains(HasSubstr("robot.safe"))));
  expect_uploaded_goals_achieved(mission);
  EXPECT_EQ(mission.mission().outcome(), "partial") << "some were hard, and a service of the run sent them";
  EXPECT_EQ(mission.mission().replans(), 0U);
}

// The sample that depot sets down is the one of goal soil.
TEST(Goals, AGoalWhoseSampleIsRecalledFailsAlone) {
  MissionInProcess mission;
  v1::Goal recall = goal("soil", "pick_sample", {{"x", "150"}, {"y", "120"}});
  recall.recalled(true);
  mission.send(100s, recall);
  mission.run();
  EXPECT_EQ(mission.goal("soil").states.back(), v1::GOAL_RECALLED);
  EXPECT_EQ(mission.goal("ridge").states.back(), v1::GOAL_ACHIEVED) << mission.goal("ridge").reason;
  EXPECT_EQ(mission.goal("depot").states.back(), v1::GOAL_FAILED);
}

TEST(Goals, ARecalledOneIsGivenUpAndTheRestGoesOn) {
  MissionInProcess mission;
  v1::Goal recall = goal("ridge", "photo", {{"x", "110"}, {"y", "60"}});
  recall.recalled(true);
  mission.send(100s, recall);
  mission.run();
  EXPECT_THAT(mission.goal("ridge").states,
              ElementsAre(v1::GOAL_PENDING, v1::GOAL_PLANNED, v1::GOAL_RECALLED));
  EXPECT_EQ(mission.goal("soil").states.back(), v1::GOAL_ACHIEVED);
  EXPECT_EQ(mission.goal("depot").states.back(), v1::GOAL_ACHIEVED);
  EXPECT_EQ(mission.mission().outcome(), "achieved");
}

}  // namespace
}  // namespace roci::scenario
