// A plan for two rovers, written by hand as timelines with transitions (R128, R131, R137, R141-R144): a scout
// tests the way, the primary follows. Every value of a timeline must end before the latest next change of
// that timeline; whether the primary follows or the scout is brought back is left open, and is decided when
// the scout has arrived.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {
namespace {

using temporal::TimePoint;
using ::testing::Contains;
using ::testing::ElementsAre;

/// Transitions of the flexible timelines, [min, max] seconds after the one before:
///
///              t1           t2 [20,40]      t3 [60,120]        t4 [50,100]       H = 400
///   pr.path    plan-paths   idle            idle               idle
///   sr.loco    idle         traverse        idle   (or bring-back)
///   pr.loco    idle         idle            follow (or idle)   idle
///   pr.comms   idle         idle            idle               report
struct TwoRovers {
  PlanBuilder b;
  TimePoint t1 = b.point(), t2 = b.point(), t3 = b.point(), t4 = b.point(), horizon = b.point();

  TwoRovers() {
    b.window(t1, 0, 0);
    b.between(t1, t2, 20, 40);
    b.between(t2, t3, 60, 120);
    b.between(t3, t4, 50, 100);
    b.window(horizon, 400, 400);
    value("plan-paths", "path-planning", "pr.path", 20, t1, t2);
    value("traverse", "scout", "sr.loco", 60, t2, t3);
    value("follow", "primary", "pr.loco", 50, t3, t4);
    value("bring-back", "scout", "sr.loco", 40, t3, t4);
    value("report", "comms", "pr.comms", 10, t4, horizon);
    activity("traverse").pre = compare("sr.map", ConditionOp::eq, state("received"));
    activity("follow").goals_served = {"ground/1"};
    b.plan.decisions = {{"go-on", "ground", {{"follow", {"follow"}}, {"bring-back", {"bring-back"}}}, t3}};
  }

  PlanActivity& activity(const std::string& id) {
    return *std::find_if(b.plan.activities.begin(), b.plan.activities.end(),
                         [&](const PlanActivity& activity) { return activity.id == id; });
  }

 private:
  /// A decision with a command from one transition to another: its value holds on the timeline all the while.
  void value(const std::string& id, const std::string& owner, const std::string& timeline, double shortest,
             TimePoint from, TimePoint to) {
    b.activity(id, owner, shortest, -1).lateness = temporal::LatenessPolicy::deadline;
    b.between(from, b.start(id), 0, 0);
    b.between(b.end(id), to, 0);
    b.token(timeline, state(id), b.start(id), to);
  }
};

TEST(TwoRoverPlan, TheScoutArrivesAndThePrimaryFollows) {
  TwoRovers rovers;
  ScriptedWorld world(rovers.b.plan);
  world.answers("plan-paths", {{.lasts = 25}});
  world.answers("traverse", {{.lasts = 100}});  // repaired on the way, inside its time
  world.observe(24, "sr.map", state("received"));
  world.at(130, {.answers = {{"go-on", "follow"}}});
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 execute plan-paths#1", "0 plan-paths running", "25 plan-paths succeeded",  //
                  "25 execute traverse#1", "25 traverse running", "125 traverse succeeded",
                  "125 ask ground: go-on? follow bring-back",
                  "130 bring-back skipped (decision go-on: follow)",  //
                  "130 execute follow#1", "130 follow running", "180 follow succeeded",
                  "180 execute report#1", "180 report running", "190 report succeeded", "190 plan finished"));
  const auto tokens = world.executive.tokens();
  EXPECT_EQ(tokens[1].started, seconds(25));  // sr.loco traverse
  EXPECT_EQ(tokens[1].ended, seconds(130));
  EXPECT_EQ(tokens[2].started, seconds(130));  // pr.loco follow
  EXPECT_EQ(tokens[3].started, std::nullopt);  // sr.loco bring-back never was
  EXPECT_EQ(tokens[4].ended, seconds(400));    // the horizon
}

TEST(TwoRoverPlan, TheGroundBringsTheScoutBack) {
  TwoRovers rovers;
  ScriptedWorld world(rovers.b.plan);
  world.observe(0, "sr.map", state("received"));
  world.at(85, {.answers = {{"go-on", "bring-back"}}});
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 execute plan-paths#1", "0 plan-paths running", "20 plan-paths succeeded",  //
                  "20 execute traverse#1", "20 traverse running", "80 traverse succeeded",
                  "80 ask ground: go-on? follow bring-back",
                  "85 follow skipped (decision go-on: bring-back)",  //
                  "85 execute bring-back#1", "85 bring-back running", "125 bring-back succeeded",
                  "135 execute report#1", "135 report running", "145 report succeeded", "145 plan finished"));
}

TEST(TwoRoverPlan, ARepairThatOverrunsItsTimeIsEscalated) {
  TwoRovers rovers;
  rovers.activity("traverse").contingency = "hold-scout";
  ScriptedWorld world(rovers.b.plan);
  world.observe(0, "sr.map", state("received"));
  world.answers("traverse", {{.lasts = 121}});
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 execute plan-paths#1", "0 plan-paths running", "20 plan-paths succeeded",  //
                  "20 execute traverse#1", "20 traverse running",
                  "140.000001 traverse running (still running at its deadline 140 s)",
                  "140.000001 cancel traverse#1",
                  "140.000001 plan broken: deadline_passed, traverse, still running at its deadline 140 s",
                  "140.000001 traverse failed (still running at its deadline 140 s)"));
  EXPECT_EQ(world.executive.outcome().contingency, "hold-scout");
}

TEST(TwoRoverPlan, AMapThatDoesNotArriveIsNamed) {
  TwoRovers rovers;
  ScriptedWorld world(rovers.b.plan);
  world.answers("plan-paths", {{.lasts = 22}});
  EXPECT_THAT(world.run(),
              Contains("40.000001 plan broken: late_start, traverse, latest start 40 s has passed; it "
                       "needs sr.map = received (never observed)"));
}

TEST(TwoRoverPlan, WithoutADecisionThePlanIsBrokenAtTheLatestTransition) {
  TwoRovers rovers;
  ScriptedWorld world(rovers.b.plan);
  world.observe(0, "sr.map", state("received"));
  EXPECT_THAT(world.run(),
              Contains("140.000001 plan broken: decision_missing, go-on, no answer from ground in time"));
}

}  // namespace
}  // namespace roci::exec::testing
