// R68, R84-R86, R99: conditions, command answers, retries, lost owners, cancel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {

using executive::CommandStage;
using executive::Executive;
using executive::Inputs;
using executive::OutcomeKind;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

PlanBuilder one(const std::function<void(PlanActivity&)>& with, const std::string& owner = "sim") {
  PlanBuilder b;
  with(b.activity("drive", owner, 100));
  return b;
}

const temporal::Condition armed = compare("arm", ConditionOp::eq, state("stowed"));
const temporal::Condition window_open = compare("window", ConditionOp::eq, true);

TEST(Preconditions, FalseOrUnknownWaitAndThenStart) {
  ScriptedWorld world(one([](PlanActivity& a) { a.pre = armed; }).plan);
  world.observe(3, "arm", state("moving"));
  world.observe(7, "arm", state("stowed"));
  EXPECT_THAT(world.run(), ElementsAre("7 execute drive#1", "7 drive running", "107 drive succeeded",
                                       "107 plan finished"));
}

TEST(Preconditions, UnmetWithinTheWaitTimeoutFailWithTheReason) {
  ScriptedWorld unknown(one([](PlanActivity& a) { a.pre = armed, a.wait_timeout = seconds(20); }).plan);
  EXPECT_THAT(
      unknown.run(),
      ElementsAre("20 drive failed (could not start within its wait timeout: arm = stowed (never observed))",
                  "20 plan broken: activity_failed, drive, could not start within its wait timeout: arm = "
                  "stowed (never observed)"));
  ScriptedWorld in_time(one([](PlanActivity& a) { a.pre = armed, a.wait_timeout = seconds(20); }).plan);
  in_time.observe(20, "arm", state("stowed"));
  EXPECT_THAT(in_time.run(), Contains("20 execute drive#1"));
}

TEST(Preconditions, AWaitOfWhatIsCommittedGoesOnUnderTheNextVersion) {
  const auto fails_at = [](temporal::CommitState commit) {
    const PlanBuilder b = one([&](PlanActivity& a) {
      a.pre = armed;
      a.wait_timeout = seconds(20);
      a.commit = commit;
    });
    Executive executive;
    EXPECT_TRUE(executive.load(b.plan, {}).empty());
    double now = 0;
    for (; now < 100; now += 5) {
      if (now == 15) {
        EXPECT_TRUE(executive.load(b.plan, seconds(now)).empty());
      }
      if (executive.step(seconds(now), {}).outcome.kind == OutcomeKind::broken) break;
    }
    return now;
  };
  EXPECT_EQ(fails_at(temporal::CommitState::committed), 20);
  EXPECT_EQ(fails_at(temporal::CommitState::planned), 35) << "its start may be another one";
}

TEST(Preconditions, UnmetUntilTheLatestStartBreakThePlanWithTheReason) {
  PlanBuilder b = one([](PlanActivity& a) { a.pre = armed; });
  b.window(b.start("drive"), 0, 30);
  ScriptedWorld world(b.plan);
  world.observe(1, "arm", state("moving"));
  EXPECT_THAT(world.run(),
              ElementsAre("30.000001 plan broken: late_start, drive, latest start 30 s has passed; it "
                          "needs arm = stowed (is moving)"));
}

TEST(Preconditions, WithoutAnyBoundTheDefaultWaitApplies) {
  ScriptedWorld world(one([](PlanActivity& a) { a.pre = armed; }).plan, {.default_wait = seconds(500)});
  EXPECT_THAT(world.run(), Contains(::testing::HasSubstr("500 plan broken: activity_failed")));
}

TEST(Skipping, ByConditionAndInsteadOfFailing) {
  PlanBuilder b;
  b.activity("excavate", "sim", 100).skip_if = compare("excavated", ConditionOp::eq, true);
  PlanActivity& image = b.activity("image", "sim", 10);
  image.pre = armed;
  image.wait_timeout = seconds(5);
  image.may_skip = true;
  b.activity("collect", "sim", 50);
  b.after("excavate", "image");
  b.after("image", "collect");
  ScriptedWorld world(b.plan);
  world.observe(0, "excavated", true);
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 excavate skipped (skipped: excavated = true)",
                  "5 image skipped (could not start within its wait timeout: arm = stowed (never observed))",
                  "5 execute collect#1", "5 collect running", "55 collect succeeded", "55 plan finished"));
}

TEST(Skipping, KeepsTheOrderOfItsNeighbours) {
  PlanBuilder b;
  b.activity("a", "sim", 100);
  b.activity("b", "sim", 100).skip_if = compare("done", ConditionOp::eq, true);
  b.activity("c", "sim", 10);
  b.after("a", "b");
  b.after("b", "c");
  ScriptedWorld world(b.plan);
  world.observe(0, "done", true);
  EXPECT_THAT(world.run(), Contains("100.001 execute c#1"));
}

TEST(Maintenance, BrokenFailsAndCancels) {
  ScriptedWorld world(one([](PlanActivity& a) { a.maintenance = window_open, a.contingency = "stow"; }).plan);
  world.observe(0, "window", true);
  world.observe(40, "window", false);
  EXPECT_THAT(
      world.run(),
      ElementsAre(
          "0 execute drive#1", "0 drive running",
          "40 drive running (maintenance condition broken: window = true (is false))", "40 cancel drive#1",
          "40 plan broken: activity_failed, drive, maintenance condition broken: window = true (is false)",
          "40 drive failed (maintenance condition broken: window = true (is false))"));
  EXPECT_EQ(world.executive.outcome().contingency, "stow");
}

TEST(Maintenance, BroughtAboutByItsOwnStartHasTheSettleTime) {
  ScriptedWorld settled(one([](PlanActivity& a) { a.maintenance = window_open; }).plan);
  settled.observe(0, "window", false);
  settled.observe(1.5, "window", true);
  EXPECT_THAT(settled.run(), Contains("100 plan finished"));
  ScriptedWorld never(one([](PlanActivity& a) { a.maintenance = window_open; }).plan);
  never.observe(0, "window", false);
  EXPECT_THAT(never.run(), Contains("2 cancel drive#1"));
}

TEST(Postconditions, AreAwaitedForTheSettleTimeOnly) {
  ScriptedWorld held(one([](PlanActivity& a) { a.post = armed; }).plan);
  held.observe(101, "arm", state("stowed"));
  EXPECT_THAT(held.run(), Contains("101 drive succeeded"));
  ScriptedWorld failed(one([](PlanActivity& a) { a.post = armed; }).plan);
  EXPECT_THAT(failed.run(),
              Contains("102 drive failed (post condition does not hold: arm = stowed (never observed))"));
}

TEST(Commands, EarlySuccessWaitsForTheDurationUnderPush) {
  ScriptedWorld world(one([](PlanActivity& a) {
                        a.lateness = temporal::LatenessPolicy::push;
                        a.wait_timeout = seconds(10);
                      }).plan);
  world.answers("drive", {{.lasts = 60}});
  EXPECT_THAT(world.run(), Contains("100 drive succeeded"));
}

TEST(Commands, NoAnswerFailsWithItsCause) {
  ScriptedWorld world(one([](PlanActivity&) {}).plan);
  world.answers("drive", {{.accepts = false, .answers_cancel = false}});
  EXPECT_THAT(
      world.run(),
      ElementsAre(
          "0 execute drive#1", "5 cancel drive#1",
          "5 plan broken: activity_failed, drive, command not answered by sim within 5 s",
          "10 drive failed (command not answered by sim within 5 s; cancel not answered within 5 s)"));
}

TEST(Commands, NoAnswerIsTriedAgainOnceTheOwnerConfirmsTheCancel) {
  ScriptedWorld world(one([](PlanActivity& a) { a.retries = 1; }).plan);
  world.answers("drive", {{.accepts = false}, {}});
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "5 cancel drive#1", "5 execute drive#2",
                          "5 drive running (retry after: command not answered by sim within 5 s)",
                          "105 drive succeeded", "105 plan finished"));
}

TEST(Commands, FailureIsRetriedAtOnceWhilePreconditionsHold) {
  PlanBuilder b = one([](PlanActivity& a) { a.retries = 2, a.pre = armed; });
  b.activity("photo", "sim", 10);
  b.after("drive", "photo");
  const Answer fails{.lasts = 30, .ends_with = CommandStage::failed, .reason = "slip"};
  ScriptedWorld world(b.plan);
  world.observe(0, "arm", state("stowed"));
  world.answers("drive", {fails, {}});
  EXPECT_THAT(world.run(), ElementsAre("0 execute drive#1", "0 drive running", "30 execute drive#2",
                                       "30 drive running (retry after: failed: slip)", "130 drive succeeded",
                                       "130.001 execute photo#1", "130.001 photo running",
                                       "140.001 photo succeeded", "140.001 plan finished"));
  ScriptedWorld spent(b.plan);
  spent.observe(0, "arm", state("stowed"));
  spent.answers("drive", {fails});
  EXPECT_THAT(spent.run(), Contains("90 plan broken: activity_failed, drive, failed: slip"));
  ScriptedWorld unmet(b.plan);
  unmet.observe(0, "arm", state("stowed"));
  unmet.observe(10, "arm", state("moving"));
  unmet.answers("drive", {fails});
  EXPECT_THAT(unmet.run(), Contains("30 plan broken: activity_failed, drive, failed: slip"));
}

TEST(Commands, RejectionFails) {
  ScriptedWorld world(one([](PlanActivity&) {}).plan);
  world.answers("drive", {{.accepts = false}});
  world.at(1, {.acks = {{"drive", 1, CommandStage::rejected, "E7", "no map"}}});
  EXPECT_THAT(world.run(), Contains("1 plan broken: activity_failed, drive, rejected [E7]: no map"));
}

TEST(Commands, AHungOwnerIsNotWaitedForEndlessly) {
  ScriptedWorld world(one([](PlanActivity&) {}).plan, {.overrun_factor = 2, .overrun_grace = seconds(50)});
  world.answers("drive", {{.lasts = 1e9}});
  EXPECT_THAT(world.run(),
              Contains("250 plan broken: activity_failed, drive, no end long after its longest duration"));
}

TEST(Commands, AnswersThatMatchNothingAreCountedAndIgnored) {
  PlanBuilder b = one([](PlanActivity& a) { a.retries = 1; });
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 10, .ends_with = CommandStage::failed}, {}});
  world.at(20, {.acks = {{"drive", 1, CommandStage::completed, "", "late"}}});
  world.at(30, {.acks = {{"nobody", 1, CommandStage::completed, "", ""},
                         {"drive", 3, CommandStage::failed, "", ""}}});
  world.at(500, {.acks = {{"drive", 2, CommandStage::failed, "", "after the end"}}});
  EXPECT_THAT(world.run(), Contains("110 plan finished"));
  EXPECT_EQ(world.executive.ignored_acks(), 4U);
}

TEST(Owners, OneThatCameBackInTimeIsAskedForItsRunningStepsOnly) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("move", "arm", 100);
  b.activity("later", "arm", 100);
  b.after("move", "later");
  ScriptedWorld world(b.plan);
  world.at(50, {.found_owners = {"arm"}});
  const auto lines = world.run();
  EXPECT_THAT(lines, Contains("50 query move#1"));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("query drive"))));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("query later"))));
  EXPECT_THAT(lines, Contains(HasSubstr("plan finished")));
}

TEST(Owners, ALostOwnerFailsItsRunningStepsOnly) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("move", "arm", 100);
  b.activity("later", "arm", 100);
  b.after("move", "later");
  ScriptedWorld world(b.plan);
  world.at(50, {.lost_owners = {"arm"}});
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "0 execute move#1", "0 drive running", "0 move running",
                          "50 move failed (owner arm is lost)",
                          "50 plan broken: activity_failed, move, owner arm is lost", "100 drive succeeded"));
}

TEST(Cancel, IsTwoPhase) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("photo", "sim", 10);
  b.after("drive", "photo");
  ScriptedWorld world(b.plan);
  world.cancel_at(40);
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "0 drive running", "40 drive running (cancel requested)",
                          "40 photo cancelled", "40 cancel drive#1", "40 plan cancelling",
                          "40 drive cancelled (cancel requested)", "40 plan cancelled"));
}

TEST(Cancel, WaitsBoundedAndReportsWhatDidNotTake) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.activity("move", "arm", 100);
  b.activity("count", "", 100);
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.answers_cancel = false}});
  world.answers("move", {{.answers_cancel = false}});
  world.cancel_at(40);
  world.at(41, {.acks = {{"move", 1, CommandStage::cancel_failed, "", "gripper closed"}}});
  EXPECT_THAT(
      world.run(99),
      ElementsAre("0 count running", "0 execute drive#1", "0 execute move#1", "0 drive running",
                  "0 move running", "40 drive running (cancel requested)",
                  "40 move running (cancel requested)", "40 count cancelled", "40 cancel drive#1",
                  "40 cancel move#1", "40 plan cancelling",
                  "41 move failed (cancel requested; cancel failed: gripper closed)",
                  "45 drive failed (cancel requested; cancel not answered within 5 s)", "45 plan cancelled"));
}

TEST(Cancel, CompletedMeanwhileIsASuccess) {
  ScriptedWorld world(one([](PlanActivity&) {}).plan);
  world.answers("drive", {{.answers_cancel = false}});
  world.cancel_at(98);
  EXPECT_THAT(world.run(), ::testing::IsSupersetOf(
                               {"100 drive succeeded (completed before the cancel)", "100 plan cancelled"}));
}

TEST(Loading, RefusesAFaultyPlanAndKeepsTheOld) {
  PlanBuilder b = one([](PlanActivity&) {});
  Executive executive;
  ASSERT_TRUE(executive.load(b.plan, {}).empty());
  temporal::FlexiblePlan faulty = b.plan;
  faulty.activities[0].end_point = 77;
  EXPECT_EQ(executive.load(faulty, {}).size(), 1U);
  EXPECT_EQ(executive.plan(), b.plan);
}

TEST(Loading, WhatRunsGoesOnInTheNextVersion) {
  PlanBuilder b;
  b.activity("drive", "sim", 100).commit = temporal::CommitState::committed;
  b.activity("move", "arm", 100);
  PlanBuilder next;
  next.activity("photo", "sim", 10);
  next.activity("drive", "sim", 100).commit = temporal::CommitState::committed;
  next.after("drive", "photo");
  ScriptedWorld world(b.plan);
  world.load_at(60, next.plan);
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute drive#1", "0 execute move#1", "0 drive running", "0 move running",
                          "60 cancel move#1", "100 drive succeeded", "100.001 execute photo#1",
                          "100.001 photo running", "110.001 photo succeeded", "110.001 plan finished"));
}

// Its owner tells an old key by the plan that issued it.
TEST(Loading, AKeyKeepsThePlanThatIssuedIt) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  b.plan.version = 3;
  Executive executive;
  ASSERT_THAT(executive.load(b.plan, seconds(0)), IsEmpty());
  EXPECT_EQ(executive.step(seconds(0), {}).commands.at(0).plan, 3U);
  executive.step(seconds(1), {.acks = {{"drive", 1, CommandStage::accepted, "", ""}}});
  PlanBuilder next;
  next.activity("drive", "sim", 100);
  next.activity("photo", "camera", 10);
  next.plan.version = 50;
  ASSERT_THAT(executive.load(next.plan, seconds(10)), IsEmpty());
  EXPECT_EQ(executive.step(seconds(10), {}).commands.at(0).plan, 50U);
  executive.step(seconds(11), {.acks = {{"photo", 1, CommandStage::accepted, "", ""}}});
  EXPECT_EQ(executive.resume(seconds(20)).commands.at(0).plan, 3U) << "a question";
  Inputs refused{.acks = {{"drive", 1, CommandStage::rejected, "old-epoch", ""}}, .epoch = 9};
  refused.acks.front().refused_epoch = true;
  EXPECT_EQ(executive.step(seconds(21), refused).commands.at(0).plan, 3U) << "the question again";
  EXPECT_EQ(executive.cancel_all(seconds(30)).commands.at(0).plan, 3U);
}

TEST(Loading, WithoutAPlanObservationsAreKept) {
  Executive executive;
  EXPECT_EQ(executive.step(seconds(1), {.observations = {{"battery", 12.0}}}).outcome.kind,
            OutcomeKind::idle);
  EXPECT_EQ(executive.value_of("battery"), temporal::Value{12.0});
  EXPECT_EQ(executive.value_of("heat"), std::nullopt);
}

}  // namespace
}  // namespace roci::exec::testing
