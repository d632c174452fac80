// Time points that no command moves: internal activities, tokens, decisions, simultaneous points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {
namespace {

using temporal::ImpactKind;
using temporal::ImpactWhen;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(InternalActivities, StartAndEndByTheNetworkAndMoveInternalTimelines) {
  PlanBuilder b;
  b.activity("heat", "", 60, -1).impacts = {{"heater", ImpactKind::assign, ImpactWhen::during, state("on")},
                                            {"warmth", ImpactKind::rate, ImpactWhen::during, 0.5},
                                            {"power", ImpactKind::delta, ImpactWhen::during, 25.0},
                                            {"cycles", ImpactKind::delta, ImpactWhen::at_end, 1.0}};
  PlanActivity& drill = b.activity("drill", "sim", 10);
  drill.pre = compare("warmth", ConditionOp::ge, 30.0);
  b.window(b.start("heat"), 20);
  b.after("heat", "drill");
  ScriptedWorld world(b.plan);
  world.run(50);
  EXPECT_EQ(world.executive.value_of("heater"), state("on"));
  EXPECT_EQ(world.executive.value_of("power"), temporal::Value{25.0});
  world.run();
  EXPECT_EQ(world.executive.value_of("heater"), std::nullopt);
  EXPECT_EQ(world.executive.value_of("power"), temporal::Value{0.0});
  EXPECT_EQ(world.executive.value_of("cycles"), temporal::Value{1.0});
  EXPECT_THAT(world.trace,
              ElementsAre("20 heat running", "80 heat succeeded", "80.001 execute drill#1",
                          "80.001 drill running", "90.001 drill succeeded", "90.001 plan finished"));
}

TEST(InternalActivities, NeverOverrideWhatWasObserved) {
  PlanBuilder b;
  b.activity("assume", "", 5).impacts = {{"window", ImpactKind::assign, ImpactWhen::at_start, true}};
  ScriptedWorld world(b.plan);
  world.observe(0, "window", false);
  world.run();
  EXPECT_EQ(world.executive.value_of("window"), temporal::Value{false});
}

TEST(InternalActivities, ParentEndsWithItsChildren) {
  PlanBuilder b;
  b.activity("sampling", "", 0, -1);
  b.activity("dig", "sim", 30).parent = "sampling";
  b.between(b.start("sampling"), b.start("dig"), 0);
  b.between(b.end("dig"), b.end("sampling"), 0);
  ScriptedWorld world(b.plan);
  world.answers("dig", {{.lasts = 44}});
  EXPECT_THAT(world.run(), ElementsAre("0 sampling running", "0 execute dig#1", "0 dig running",
                                       "44 dig succeeded", "44 sampling succeeded", "44 plan finished"));
}

TEST(SimultaneousPoints, MeetAtTheObservedEnd) {
  PlanBuilder b;
  b.activity("scout", "sr", 50, 100);
  b.activity("follow", "pr", 10);
  b.between(b.end("scout"), b.start("follow"), 0, 0);
  ScriptedWorld world(b.plan);
  world.answers("scout", {{.lasts = 70}});
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute scout#1", "0 scout running", "70 scout succeeded", "70 execute follow#1",
                          "70 follow running", "80 follow succeeded", "80 plan finished"));
}

TEST(SimultaneousPoints, StartTogetherWhenAllCan) {
  PlanBuilder b;
  b.activity("slow", "sim", 50);
  b.activity("left", "sim", 10);
  b.activity("right", "sim", 10);
  b.after("slow", "right", 1);
  b.between(b.start("left"), b.start("right"), 0, 0);
  ScriptedWorld world(b.plan);
  world.answers("slow", {{.lasts = 53}});
  EXPECT_THAT(world.run(), ::testing::IsSupersetOf({"54 execute left#1", "54 execute right#1"}));
}

TEST(SimultaneousPoints, NoneStartsBeforeThePreconditionsOfAllHold) {
  PlanBuilder b;
  b.activity("left", "sim", 10);
  b.activity("right", "sim", 10).pre = compare("go", ConditionOp::eq, true);
  b.between(b.start("left"), b.start("right"), 0, 0);
  ScriptedWorld world(b.plan);
  world.observe(3, "go", true);
  EXPECT_THAT(world.run(),
              ::testing::IsSupersetOf({"3 execute left#1", "3 execute right#1", "13 plan finished"}));
}

/// No single constraint says that q comes before s, but two together do: s >= m + 10 and q <= m + 5.
TEST(ImpliedOrder, IsHeldAlsoWhereNoSingleConstraintStatesIt) {
  PlanBuilder b;
  b.activity("m", "sim", 1);
  b.activity("q", "sim", 1);
  b.activity("s", "sim", 1);
  b.between(b.start("s"), b.start("m"), 0, 4);  // m within 4 s after s
  b.between(b.start("q"), b.start("m"), 10);    // q at least 10 s before m: so at least 6 s before s
  b.plan.activities[1].pre = compare("go", ConditionOp::eq, true);
  ScriptedWorld world(b.plan);
  world.observe(100, "go", true);
  EXPECT_THAT(world.run(),
              ::testing::IsSupersetOf({"100 execute q#1", "106 execute s#1", "110 execute m#1"}));
}

TEST(Tokens, FollowTheirPoints) {
  PlanBuilder b;
  b.activity("traverse", "rover", 50);
  const temporal::TimePoint stop = b.point();
  const temporal::TimePoint horizon = b.point();
  b.between(b.end("traverse"), stop, 0.001);
  b.window(horizon, 200, 200);
  b.token("loco", state("traverse"), b.start("traverse"), stop);
  b.token("loco", state("idle"), stop, horizon);
  ScriptedWorld world(b.plan);
  world.answers("traverse", {{.lasts = 60}});
  world.run();
  const auto tokens = world.executive.tokens();
  EXPECT_EQ(tokens[0].started, seconds(0));
  EXPECT_EQ(tokens[0].ended, seconds(60.001));
  EXPECT_EQ(tokens[1].started, seconds(60.001));
}

/// After look, one of two routes; home follows whichever was taken.
PlanBuilder route_plan() {
  PlanBuilder b;
  b.activity("look", "sim", 10);
  b.activity("left", "sim", 20);
  b.activity("right", "sim", 30);
  b.activity("home", "sim", 5);
  for (const char* route : {"left", "right"}) {
    b.after("look", route);
    b.after(route, "home");
  }
  b.plan.decisions.push_back(
      {"route", "planner", {{"by-left", {"left"}}, {"by-right", {"right"}}}, b.point()});
  return b;
}

TEST(Decisions, AreAskedForWhenTheirActivitiesCouldStartAndSkipTheRest) {
  ScriptedWorld world(route_plan().plan);
  world.at(5, {.answers = {{"route", "by-left"}}});  // nobody has asked yet
  world.at(17, {.answers = {{"route", "by-the-moon"}}});
  world.at(18, {.answers = {{"route", "by-right"}}});
  world.at(19, {.answers = {{"route", "by-left"}}});
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 execute look#1", "0 look running", "10 look succeeded",
                  "10 ask planner: route? by-left by-right", "18 left skipped (decision route: by-right)",
                  "18 execute right#1", "18 right running", "48 right succeeded", "48.001 execute home#1",
                  "48.001 home running", "53.001 home succeeded", "53.001 plan finished"));
  EXPECT_EQ(world.executive.ignored_answers(), 3U);
}

// R131: a plan reckons with its first choice. After another one the parents of what is left out end without having come to their end.
TEST(Decisions, AnotherChoiceThanPlannedEndsWhatItWasForUnfulfilled) {
  for (const auto& [choice, end] : {std::pair{"by-left", "succeeded"}, std::pair{"by-right", "cancelled"}}) {
    PlanBuilder b = route_plan();
    b.activity("trip", "", 0).duration_upper = temporal::no_bound;
    b.between(b.start("trip"), b.start("look"), 0, 0);
    b.between(b.end("home"), b.end("trip"), 0, 0);
    for (auto& activity : b.plan.activities)
      if (activity.id == "left") activity.parent = "trip";
    ScriptedWorld world(b.plan);
    world.at(18, {.answers = {{"route", choice}}});
    EXPECT_THAT(world.run(), Contains(HasSubstr(std::string("trip ") + end))) << choice;
  }
}

TEST(Decisions, WithoutAnAnswerInTimeThePlanIsBroken) {
  PlanBuilder b = route_plan();
  b.window(b.plan.decisions[0].decide_before, 0, 60);
  ScriptedWorld world(b.plan);
  EXPECT_THAT(world.run(),
              Contains("60.000001 plan broken: decision_missing, route, no answer from planner in time"));
  ScriptedWorld unbounded(route_plan().plan, {.decision_timeout = seconds(100)});
  EXPECT_THAT(unbounded.run(), Contains(HasSubstr("110.000001 plan broken: decision_missing")));
}

}  // namespace
}  // namespace roci::exec::testing
