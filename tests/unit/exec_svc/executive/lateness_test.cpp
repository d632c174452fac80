// R47-R50: when an activity starts, and when a plan is broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {

using executive::Executive;
using executive::OutcomeKind;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

/// photo follows drive, its start in [lb 150, ub 200] seconds.
PlanBuilder photo_after_drive() {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("photo", "sim", 40);
  b.after("drive", "photo");
  b.window(b.start("photo"), 150, 200);
  return b;
}

std::vector<std::string> trace_with_drive_of(double lasts) {
  ScriptedWorld world(photo_after_drive().plan);
  world.answers("drive", {{.lasts = lasts}});
  return world.run();
}

std::vector<std::string> starting_photo_at(const std::string& drive_end, const std::string& photo_start,
                                           const std::string& photo_end) {
  return {"0 execute drive#1",
          "0 drive running",
          drive_end + " drive succeeded",
          photo_start + " execute photo#1",
          photo_start + " photo running",
          photo_end + " photo succeeded",
          photo_end + " plan finished"};
}

TEST(Lateness, PredecessorsDoneBeforeLowerBoundStartAtLowerBound) {
  EXPECT_EQ(trace_with_drive_of(100), starting_photo_at("100", "150", "190"));
}

TEST(Lateness, PredecessorsDoneAtLowerBoundStartAfterEpsilon) {
  EXPECT_EQ(trace_with_drive_of(149.999), starting_photo_at("149.999", "150", "190"));
  EXPECT_EQ(trace_with_drive_of(150), starting_photo_at("150", "150.001", "190.001"));
}

TEST(Lateness, PredecessorsDoneInsideTheWindowStartAtOnce) {
  EXPECT_EQ(trace_with_drive_of(180), starting_photo_at("180", "180.001", "220.001"));
}

TEST(Lateness, PredecessorsDoneSoThatUpperBoundIsMetStart) {
  EXPECT_EQ(trace_with_drive_of(199.999), starting_photo_at("199.999", "200", "240"));
}

TEST(Lateness, OneMicrosecondAfterUpperBoundThePlanIsBroken) {
  const auto broken = "200.000001 plan broken: late_start, photo, latest start 200 s has passed";
  EXPECT_THAT(trace_with_drive_of(199.999001),
              ElementsAre("0 execute drive#1", "0 drive running", "199.999001 drive succeeded", broken));
  EXPECT_THAT(trace_with_drive_of(250),
              ElementsAre("0 execute drive#1", "0 drive running",
                          std::string(broken) + "; it waits for drive", "250 drive succeeded"));
}

TEST(Lateness, WithoutEpsilonTheBoundariesAreExact) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("photo", "sim", 40);
  b.after("drive", "photo", 0);
  b.window(b.start("photo"), 150, 200);
  for (const auto& [lasts, start] :
       {std::pair{150.0, "150 execute photo#1"}, {200.0, "200 execute photo#1"}}) {
    ScriptedWorld world(b.plan);
    world.answers("drive", {{.lasts = lasts}});
    EXPECT_THAT(world.run(), ::testing::Contains(start));
  }
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 200.000001}});
  EXPECT_THAT(world.run(), ::testing::Contains(
                               "200.000001 plan broken: late_start, photo, latest start 200 s has passed"));
}

TEST(Lateness, LongerThanPlannedBreaksNothingByItself) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("photo", "sim", 40);
  b.after("drive", "photo");
  b.between(b.end("drive"), b.start("photo"), 0,
            10);  // close together: the window moves with the observed end
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 163}});
  EXPECT_THAT(world.run(), ElementsAre("0 execute drive#1", "0 drive running", "163 drive succeeded",
                                       "163.001 execute photo#1", "163.001 photo running",
                                       "203.001 photo succeeded", "203.001 plan finished"));
}

TEST(Lateness, ShorterThanPlannedStartsTheNextEarlier) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("photo", "sim", 40);
  b.after("drive", "photo");
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 97}});
  EXPECT_THAT(world.run(), ::testing::Contains("97.001 execute photo#1"));
}

TEST(Lateness, ParallelActivitiesRunInParallel) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("talk", "radio", 60);
  b.activity("photo", "sim", 40);
  b.after("drive", "photo");
  b.after("talk", "photo");
  ScriptedWorld world(b.plan);
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "0 execute talk#1", "0 drive running", "0 talk running",
                          "60 talk succeeded", "100 drive succeeded", "100.001 execute photo#1",
                          "100.001 photo running", "140.001 photo succeeded", "140.001 plan finished"));
}

TEST(Lateness, PushWaitsBeyondTheWindowUntilItsTimeout) {
  PlanBuilder b = photo_after_drive();
  b.plan.activities[1].lateness = temporal::LatenessPolicy::push;
  b.plan.activities[1].wait_timeout = temporal::seconds(90);  // from 150
  ScriptedWorld pushed(b.plan);
  pushed.answers("drive", {{.lasts = 230}});
  EXPECT_THAT(pushed.run(), ::testing::Contains("230.001 execute photo#1"));
  ScriptedWorld failed(b.plan);
  failed.answers("drive", {{.lasts = 241}});
  EXPECT_THAT(
      failed.run(),
      ElementsAre("0 execute drive#1", "0 drive running",
                  "240 photo failed (could not start within its wait timeout: a predecessor has not ended)",
                  "240 plan broken: activity_failed, photo, could not start within its wait timeout: a "
                  "predecessor has not ended",
                  "241 drive succeeded"));
}

TEST(Lateness, AWaitDoesNotRunWhileItsPredecessorHasNotBegun) {
  PlanBuilder b;
  for (const char* id : {"a", "b", "c"}) {
    temporal::PlanActivity& activity = b.activity(id, "sim", 10);
    activity.lateness = temporal::LatenessPolicy::push;
    activity.wait_timeout = temporal::seconds(30);
  }
  b.after("a", "b");
  b.after("b", "c");
  ScriptedWorld world(b.plan);
  world.answers("a", {{.lasts = 38}});  // b is pushed by 28 s, c by 56 s
  world.answers("b", {{.lasts = 38}});
  EXPECT_THAT(world.run(), ::testing::Contains("86.002 plan finished"));
}

TEST(Lateness, DeadlineIsTheLatestNextChangeOfTheTimeline) {
  PlanBuilder b;
  b.activity("traverse", "rover", 50, 80).lateness = temporal::LatenessPolicy::deadline;
  const temporal::TimePoint change = b.point();
  b.between(b.end("traverse"), change, 0);
  b.window(change, 0, 120);
  b.token("rover.loco", temporal::state("traversing"), b.start("traverse"), change);
  ScriptedWorld in_time(b.plan);
  in_time.answers("traverse", {{.lasts = 120}});
  EXPECT_THAT(in_time.run(), ::testing::Contains("120 plan finished"));
  ScriptedWorld late(b.plan);
  late.answers("traverse", {{.lasts = 121}});
  EXPECT_THAT(
      late.run(),
      ElementsAre("0 execute traverse#1", "0 traverse running",
                  "120.000001 traverse running (still running at its deadline 120 s)",
                  "120.000001 cancel traverse#1",
                  "120.000001 plan broken: deadline_passed, traverse, still running at its deadline 120 s",
                  "120.000001 traverse failed (still running at its deadline 120 s)"));
}

// R129: what is tried again must fit into the times that the plan has.
TEST(Lateness, ARetryDoesNotMoveTheDeadline) {
  PlanBuilder b;
  temporal::PlanActivity& planned = b.activity("traverse", "rover", 50, 120);
  planned.lateness = temporal::LatenessPolicy::deadline;
  planned.retries = 3;
  const Answer stuck{.lasts = 30, .ends_with = executive::CommandStage::failed, .reason = "stuck"};
  ScriptedWorld fits(b.plan);
  fits.answers("traverse", {stuck, stuck, {.lasts = 60}});
  EXPECT_THAT(fits.run(), Contains("120 plan finished"));
  ScriptedWorld overruns(b.plan);
  overruns.answers("traverse", {stuck, stuck, {.lasts = 61}});
  EXPECT_THAT(overruns.run(), Contains("120.000001 plan broken: deadline_passed, traverse, still running at "
                                       "its deadline 120 s"));
  ScriptedWorld no_room(b.plan);
  no_room.answers("traverse", {stuck});
  EXPECT_THAT(no_room.run(), Contains("90 plan broken: activity_failed, traverse, failed: stuck"))
      << "the shortest attempt would end at 140 s";
}

TEST(Lateness, EndsInTheWrongOrderBreakThePlan) {
  PlanBuilder b;
  b.activity("short", "sim", 10);
  b.activity("long", "arm", 20);
  b.between(b.end("short"), b.end("long"), 0.001);
  ScriptedWorld world(b.plan);
  world.answers("short", {{.lasts = 25}});
  EXPECT_THAT(world.run(), ::testing::Contains(
                               "20 plan broken: ordering_violated, long, it ended before short had ended"));
}

TEST(Lateness, ALateStartAtLoadIsCaughtUpInsideTheWindow) {
  PlanBuilder b;
  b.activity("photo", "sim", 40);
  b.window(b.start("photo"), 10, 50);
  for (const auto& [now, kind] : {std::pair{50.0, OutcomeKind::running}, {50.000001, OutcomeKind::broken}}) {
    Executive executive;
    ASSERT_TRUE(executive.load(b.plan, temporal::seconds(now)).empty());
    EXPECT_EQ(executive.step(temporal::seconds(now), {}).outcome.kind, kind);
  }
}

}  // namespace
}  // namespace roci::exec::testing
