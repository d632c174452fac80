// The recovery actions that need no planner: push, retry, contingency (R69, R70, R98, R99, R141), the
// owner's own repair (R146), and each of them told with its cause.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {

using executive::CommandAck;
using executive::CommandAction;
using executive::CommandStage;
using executive::Contingency;
using executive::Executive;
using executive::ExecutiveSettings;
using executive::OutcomeKind;
using executive::Outputs;
using executive::StartPolicy;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

const Answer stuck{.lasts = 30, .ends_with = CommandStage::failed, .reason = "stuck"};

Contingency back_off(bool retries) {
  return {"back-off",
          {{"sim", "nav", "reverse", {{"towards", "{to}"}}}, {"sim", "nav", "look", {}}},
          retries,
          1,
          seconds(60)};
}

ExecutiveSettings with(const Contingency& contingency) {
  ExecutiveSettings settings;
  settings.contingencies[contingency.name] = contingency;
  return settings;
}

/// drive, then image; another component works beside them.
PlanBuilder drive_and_image() {
  PlanBuilder b;
  PlanActivity& drive = b.activity("drive", "sim", 100);
  drive.contingency = "back-off";
  drive.arguments = {{"to", "rock"}};
  b.activity("image", "sim", 10);
  b.activity("heat", "sim", 400);
  b.after("drive", "image");
  return b;
}

TEST(Contingencies, CommandsAreSentAtOnceThenTheActivityIsTriedAgainAndOthersRunOn) {
  ScriptedWorld world(drive_and_image().plan, with(back_off(true)));
  world.answers("drive", {stuck, {.lasts = 100}});
  world.answers("drive.c1-reverse", {{.lasts = 5}});
  world.answers("drive.c2-look", {{.lasts = 2}});
  EXPECT_THAT(world.run(),
              IsSupersetOf({"30 execute drive.c1-reverse#1", "35 execute drive.c2-look#1",
                            "37 execute drive#2", "137 drive succeeded", "137.001 execute image#1",
                            "400 heat succeeded", "400 plan finished"}));
  EXPECT_THAT(world.recoveries,
              ElementsAre("30 contingency drive: back-off, 1 of 1, after: failed: stuck",
                          "37 contingency drive: back-off is done, the activity is tried again"));
  EXPECT_EQ(world.arguments["drive.c1-reverse"], "rock");
}

TEST(Contingencies, WithoutARetryThePlanIsBrokenWhenTheyAreDone) {
  ScriptedWorld world(drive_and_image().plan, with(back_off(false)));
  world.answers("drive", {stuck});
  EXPECT_THAT(world.run(), Contains("30 plan broken: activity_failed, drive, failed: stuck; contingency "
                                    "back-off is done"));
}

TEST(Contingencies, AreUsedAsOftenAsTheySayThenThePlanIsBroken) {
  Contingency twice = back_off(true);
  twice.times = 2;
  ScriptedWorld world(drive_and_image().plan, with(twice));
  world.answers("drive", {stuck});
  world.answers("heat", {{.lasts = 5}});
  world.run();
  EXPECT_EQ(std::count_if(world.trace.begin(), world.trace.end(),
                          [](const std::string& line) { return line.find("execute drive#") != line.npos; }),
            3);
  EXPECT_THAT(world.trace, Contains("90 plan broken: activity_failed, drive, failed: stuck"));
}

TEST(Contingencies, ComeAfterTheRetries) {
  PlanBuilder b = drive_and_image();
  b.plan.activities[0].retries = 1;
  ScriptedWorld world(b.plan, with(back_off(true)));
  world.answers("drive", {stuck, stuck, {.lasts = 100}});
  world.run();
  EXPECT_THAT(world.recoveries,
              ElementsAre("30 retry drive: retry 1 of 1 after: failed: stuck",
                          "60 contingency drive: back-off, 1 of 1, after: failed: stuck",
                          "60 contingency drive: back-off is done, the activity is tried again"));
  EXPECT_THAT(world.trace, Contains("160 drive succeeded"));
}

TEST(Contingencies, ThatFailOrTakeTooLongOrAreNotHeardBreakThePlan) {
  ScriptedWorld failing(drive_and_image().plan, with(back_off(true)));
  failing.answers("drive", {stuck});
  failing.answers("drive.c1-reverse", {stuck});
  EXPECT_THAT(failing.run(),
              Contains(HasSubstr("60 plan broken: activity_failed, drive, failed: stuck; contingency "
                                 "back-off did not help: one of its commands failed: stuck")));
  ScriptedWorld slow(drive_and_image().plan, with(back_off(true)));
  slow.answers("drive", {stuck});
  slow.answers("drive.c1-reverse", {{.lasts = 500}});
  EXPECT_THAT(slow.run(), IsSupersetOf({"90 cancel drive.c1-reverse#1"}));
  EXPECT_THAT(slow.trace, Contains(HasSubstr("not done within 60 s")));
  ScriptedWorld deaf(drive_and_image().plan, with(back_off(true)));
  deaf.answers("drive", {stuck});
  deaf.answers("drive.c1-reverse", {{.accepts = false}});
  EXPECT_THAT(deaf.run(), Contains(HasSubstr("35 plan broken")));
}

TEST(Contingencies, OfACommandThatMayStillRunBeginWhenItsCancelIsConfirmed) {
  ScriptedWorld world(drive_and_image().plan, with(back_off(true)));
  world.answers("drive", {{.accepts = false}, {.lasts = 100}});
  EXPECT_THAT(world.run(), IsSupersetOf({"5 cancel drive#1", "5 execute drive.c1-reverse#1"}));
  ScriptedWorld never(drive_and_image().plan, with(back_off(true)));
  never.answers("drive", {{.accepts = false, .answers_cancel = false}});
  never.run();
  EXPECT_THAT(never.trace, Contains(HasSubstr("10 plan broken")));
  EXPECT_THAT(never.trace, Not(Contains(HasSubstr("reverse"))));
}

TEST(Contingencies, OfALostOwnerAreGivenUpAndACancelledPlanTakesThemAlong) {
  ScriptedWorld lost(drive_and_image().plan, with(back_off(true)));
  lost.answers("drive", {stuck});
  lost.answers("drive.c1-reverse", {{.lasts = 50}});
  lost.at(40, {.lost_owners = {"sim"}});
  EXPECT_THAT(lost.run(),
              Contains(HasSubstr("40 plan broken: activity_failed, drive, failed: stuck; contingency "
                                 "back-off did not help: owner sim is lost")));
  ScriptedWorld cancelled(drive_and_image().plan, with(back_off(true)));
  cancelled.answers("drive", {stuck});
  cancelled.answers("drive.c1-reverse", {{.lasts = 50}});
  cancelled.cancel_at(40);
  EXPECT_THAT(cancelled.run(), IsSupersetOf({"40 cancel drive.c1-reverse#1", "40 plan cancelled"}));
}

TEST(Contingencies, UnderWayAtARestartAreAskedForAndSentAgainUnderTheSameKeyIfUnknown) {
  Executive executive(with(back_off(true)));
  ASSERT_TRUE(executive.load(drive_and_image().plan, seconds(0)).empty());
  const auto ack = [](const std::string& id, CommandStage stage) { return CommandAck{id, 1, stage, "", ""}; };
  executive.step(seconds(0), {});
  executive.step(seconds(1),
                 {.acks = {ack("drive", CommandStage::failed), ack("heat", CommandStage::accepted)}});
  const Outputs asked = executive.resume(seconds(3));
  ASSERT_EQ(asked.commands.size(), 2U);
  EXPECT_EQ(asked.commands[0].activity, "drive.c1-reverse");
  EXPECT_EQ(asked.commands[0].action, CommandAction::query);
  const Outputs again =
      executive.step(seconds(7), {.acks = {ack("drive.c1-reverse", CommandStage::unknown)}});
  ASSERT_EQ(again.commands.size(), 1U);
  EXPECT_EQ(again.commands[0].activity, "drive.c1-reverse");
  EXPECT_EQ(again.commands[0].action, CommandAction::execute);
  EXPECT_EQ(again.outcome.kind, OutcomeKind::running);
}

TEST(Retries, EndWhenTheirTimeIsOver) {
  PlanBuilder b;
  b.activity("drive", "sim", 100).retries = 9;
  ExecutiveSettings settings;
  settings.retry_within["drive"] = seconds(70);
  ScriptedWorld world(b.plan, settings);
  world.answers("drive", {stuck});
  EXPECT_THAT(world.run(), Contains("90 plan broken: activity_failed, drive, failed: stuck"));
  EXPECT_EQ(world.recoveries.size(), 2U);
}

// Two may not have the hand at once; an activity's own claim does not forbid it another attempt.
TEST(Retries, GiveBackWhatTheFailedAttemptHadTakenAndOthersWaitForTheEnd) {
  PlanBuilder b;
  PlanActivity& begin = b.activity("begin", "", 0);
  begin.impacts = {{"hand", temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, 0.0}};
  for (const char* id : {"drive", "image"}) {
    PlanActivity& one = b.activity(id, "sim", 10);
    one.pre = temporal::compare("hand", temporal::ConditionOp::le, 0.0);
    one.impacts = {{"hand", temporal::ImpactKind::delta, temporal::ImpactWhen::during, 1.0}};
    one.retries = 1;
    one.lateness = temporal::LatenessPolicy::push;
    one.wait_timeout = seconds(1000);
    b.after("begin", id);
  }
  ScriptedWorld world(b.plan);
  world.answers("drive",
                {{.lasts = 30, .ends_with = CommandStage::failed, .reason = "stuck"}, {.lasts = 10}});
  world.answers("image", {{.lasts = 10}});
  EXPECT_THAT(world.run(),
              IsSupersetOf({"0.001 execute drive#1", "30.001 execute drive#2", "40.001 drive succeeded",
                            "40.001 execute image#1", "50.001 plan finished"}));
}

TEST(Push, IsToldWithWhatItWaitsForAndUntilWhen) {
  PlanBuilder b;
  PlanActivity& drive = b.activity("drive", "sim", 100);
  drive.pre = compare("arm", ConditionOp::eq, state("stowed"));
  drive.lateness = temporal::LatenessPolicy::push;
  drive.wait_timeout = seconds(50);
  ScriptedWorld world(b.plan);
  world.observe(7, "arm", state("stowed"));
  EXPECT_THAT(world.run(), Contains("107 plan finished"));
  EXPECT_THAT(world.recoveries,
              ElementsAre("0 push drive: waits until 50 s for arm = stowed (never observed)"));
}

TEST(OwnersRepair, WithinTheStepIsVisibleAsAStatusAndNothingMore) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  ScriptedWorld world(b.plan);
  world.at(40, {.acks = {{"drive", 1, CommandStage::accepted, "repairing", "second way around a rock"}}});
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "0 drive running",
                          "40 drive running (its owner repairs [repairing]: second way around a rock)",
                          "100 drive succeeded", "100 plan finished"));
  EXPECT_TRUE(world.recoveries.empty());
}

TEST(StartPolicies, EarliestAtTheLowerBoundLatestAtTheUpperOne) {
  PlanBuilder b;
  b.activity("a", "sim", 10);
  b.activity("b", "sim", 10);
  b.after("a", "b", 1);
  b.window(b.start("a"), 5, 40);
  b.window(b.end("b"), 0, 100);
  ScriptedWorld early(b.plan);
  EXPECT_THAT(early.run(), IsSupersetOf({"5 execute a#1", "16 execute b#1", "26 plan finished"}));
  ScriptedWorld late(b.plan, {.start = StartPolicy::latest});
  EXPECT_THAT(late.run(), IsSupersetOf({"40 execute a#1", "90 execute b#1", "100 plan finished"}));
  ScriptedWorld too_late(b.plan, {.start = StartPolicy::latest});
  too_late.answers("a", {{.lasts = 60}});
  EXPECT_THAT(too_late.run(), Contains(HasSubstr("late_start, b")));
}

TEST(StartPolicies, WithoutAnUpperBoundLatestIsEarliest) {
  PlanBuilder b;
  b.activity("a", "sim", 10);
  ScriptedWorld world(b.plan, {.start = StartPolicy::latest});
  EXPECT_THAT(world.run(), Contains("0 execute a#1"));
}

}  // namespace
}  // namespace roci::exec::testing
