// A MEXEC-style task network, written by hand: one sampling cycle of a lander beside seismometry (R67-R73,
// R85, R86, R98, R99). Tasks are pushed, not replanned; NO-OP tasks keep internal states; the first tasks are
// committed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {

using executive::Breakage;
using executive::CommandStage;

namespace {

using temporal::ImpactKind;
using temporal::ImpactWhen;
using ::testing::ElementsAre;

PlanActivity& task(PlanBuilder& b, const std::string& id, const std::string& owner, double lasts) {
  PlanActivity& activity = b.activity(id, owner, lasts);
  activity.lateness = temporal::LatenessPolicy::push;
  activity.wait_timeout = seconds(120);
  return activity;
}

///   seismometry  [ 0 ........................................ 500 ]
///   site-1       [ prepare-arm | excavate* | collect | analyze | mark-done ]    *skipped if done before
///   downlink                                                                [ in view ]
PlanBuilder sampling_network() {
  PlanBuilder b;
  PlanActivity& seismometry = task(b, "seismometry", "", 500);
  seismometry.impacts = {{"seismometer", ImpactKind::assign, ImpactWhen::during, state("on")},
                         {"seismic-data", ImpactKind::rate, ImpactWhen::during, 2.0}};

  PlanActivity& site = task(b, "site-1", "", 0);
  site.duration_upper = temporal::no_bound;
  site.impacts = {{"phase", ImpactKind::assign, ImpactWhen::at_start, state("sampling")},
                  {"phase", ImpactKind::assign, ImpactWhen::at_end, state("downlinking")},
                  {"samples", ImpactKind::delta, ImpactWhen::at_end, 1.0}};

  PlanActivity& prepare = task(b, "prepare-arm", "arm", 30);
  prepare.parent = "site-1";
  prepare.commit = temporal::CommitState::committed;

  PlanActivity& excavate = task(b, "excavate", "arm", 100);
  excavate.parent = "site-1";
  excavate.commit = temporal::CommitState::committed;
  excavate.skip_if = compare("site-1.trench", ConditionOp::eq, state("excavated"));

  PlanActivity& collect = task(b, "collect", "arm", 60);
  collect.parent = "site-1";
  collect.retries = 1;
  collect.pre = compare("phase", ConditionOp::eq, state("sampling"));
  collect.maintenance = compare("arm.heat", ConditionOp::lt, 60.0);

  PlanActivity& analyze = task(b, "analyze", "lab", 40);
  analyze.parent = "site-1";
  analyze.post = compare("lab.product", ConditionOp::eq, state("stored"));

  PlanActivity& downlink = task(b, "downlink", "radio", 50);
  downlink.pre = temporal::all_of({compare("earth.in-view", ConditionOp::eq, true),
                                   compare("phase", ConditionOp::eq, state("downlinking")),
                                   compare("samples", ConditionOp::ge, 1.0)});
  downlink.utility = {10};

  b.between(b.start("site-1"), b.start("prepare-arm"), 0);
  b.after("prepare-arm", "excavate");
  b.after("excavate", "collect");
  b.after("collect", "analyze");
  b.between(b.end("analyze"), b.end("site-1"), 0);
  b.after("site-1", "downlink");
  b.window(b.start("downlink"), 0, 300);  // as scheduled; push does not insist
  return b;
}

void observe_a_quiet_lander(ScriptedWorld& world) {
  world.observe(0, "site-1.trench", state("untouched"));
  world.observe(0, "arm.heat", 20.0);
}

TEST(MexecPlan, RunsAsScheduled) {
  ScriptedWorld world(sampling_network().plan);
  observe_a_quiet_lander(world);
  world.observe(230, "lab.product", state("stored"));
  world.observe(200, "earth.in-view", true);
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 seismometry running", "0 site-1 running", "0 execute prepare-arm#1",  //
                  "0 prepare-arm running", "30 prepare-arm succeeded",                     //
                  "30.001 execute excavate#1", "30.001 excavate running", "130.001 excavate succeeded",
                  "130.002 execute collect#1", "130.002 collect running", "190.002 collect succeeded",
                  "190.003 execute analyze#1", "190.003 analyze running", "230.003 analyze succeeded",
                  "230.003 site-1 succeeded",  //
                  "230.004 execute downlink#1", "230.004 downlink running", "280.004 downlink succeeded",
                  "500 seismometry succeeded", "500 plan finished"));
  EXPECT_EQ(world.executive.value_of("samples"), temporal::Value{1.0});
  EXPECT_EQ(world.executive.value_of("seismometer"), std::nullopt);
  EXPECT_NEAR(std::get<double>(*world.executive.value_of("seismic-data")), 1000.0, 1e-6);
}

TEST(MexecPlan, PushesRetriesAndSkipsWithoutAPlanner) {
  ScriptedWorld world(sampling_network().plan);
  world.observe(0, "arm.heat", 20.0);
  world.observe(0, "site-1.trench", state("excavated"));
  world.answers("prepare-arm", {{.lasts = 95}});  // 65 s late
  world.answers("collect",
                {{.lasts = 20, .ends_with = CommandStage::failed, .reason = "empty scoop"}, {.lasts = 45}});
  world.observe(216.5, "lab.product", state("stored"));
  world.observe(330, "earth.in-view", true);  // after the scheduled 300
  EXPECT_THAT(
      world.run(),
      ElementsAre("0 seismometry running", "0 site-1 running", "0 execute prepare-arm#1",  //
                  "0 prepare-arm running", "95 prepare-arm succeeded",                     //
                  "95.001 excavate skipped (skipped: site-1.trench = excavated)",          //
                  "95.001 execute collect#1", "95.001 collect running", "115.001 execute collect#2",
                  "115.001 collect running (retry after: failed: empty scoop)",
                  "175.001 collect succeeded",  // the scoop was full after 45 s: success waits for the 60 s
                  "175.002 execute analyze#1", "175.002 analyze running",
                  "216.5 analyze succeeded",  // its post condition is awaited
                  "216.5 site-1 succeeded",   //
                  "330 execute downlink#1", "330 downlink running", "380 downlink succeeded",
                  "500 seismometry succeeded", "500 plan finished"));
}

TEST(MexecPlan, FailsTheTaskThatWaitedTooLong) {
  ScriptedWorld world(sampling_network().plan);
  observe_a_quiet_lander(world);
  world.observe(230, "lab.product", state("stored"));
  world.observe(240, "earth.in-view", false);
  world.run();
  EXPECT_EQ(world.executive.outcome().breakage, Breakage::activity_failed);
  EXPECT_EQ(world.executive.outcome().activity, "downlink");
  EXPECT_EQ(world.executive.outcome().reason,
            "could not start within its wait timeout: earth.in-view = true (is false)");
  EXPECT_THAT(world.trace, ::testing::Contains("500 seismometry succeeded"));  // the rest goes on
}

TEST(MexecPlan, KeepsCommitStateParentAndUtility) {
  ScriptedWorld world(sampling_network().plan);
  const temporal::FlexiblePlan& plan = world.executive.plan();
  EXPECT_EQ(plan, sampling_network().plan);
  EXPECT_EQ(plan.activities[2].commit, temporal::CommitState::committed);
}

}  // namespace
}  // namespace roci::exec::testing
