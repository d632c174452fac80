// What became of a plan (R129, R144): kept while it runs, told when it has ended.
#include "exec_svc/reactor/executed_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec {
namespace {

using executive::CommandStage;
using reactor::ExecutedOutcome;
using reactor::ExecutionRecord;
using temporal::ActivityState;
using temporal::seconds;

temporal::FlexiblePlan plan_of(std::initializer_list<const char*> ids) {
  temporal::FlexiblePlan plan;
  plan.version = 4;
  for (const char* id : ids) {
    plan.activities.emplace_back();
    plan.activities.back().id = id;
    plan.activities.back().level = "primitive";
  }
  return plan;
}

TEST(ExecutionRecord, KeepsTimesStatesAndWhatAllCommandsBrought) {
  ExecutionRecord record;
  record.begin(plan_of({"a", "b"}));
  record.note(executive::StepStatus{"a", "", 1, ActivityState::running, {}, {}, seconds(3), {}, ""});
  record.note(executive::CommandAck{"a", 1, CommandStage::accepted, "", "", 0, false, {{}, 99.0, {}}});
  record.note(executive::CommandAck{
      "a", 1, CommandStage::failed, "", "", 0, false, {seconds(2), 5.0, {{"n", 1.0}, {"m", 7.0}}}});
  record.note(executive::CommandAck{
      "a", 2, CommandStage::completed, "", "", 0, false, {seconds(4), 6.0, {{"n", 2.0}}}});
  record.note(executive::CommandAck{"stranger", 1, CommandStage::completed, "", ""});
  record.note(
      executive::StepStatus{"a", "", 2, ActivityState::succeeded, {}, {}, seconds(3), seconds(9), "at last"});
  EXPECT_TRUE(record.open());
  const reactor::ExecutedPlan done = record.close(ExecutedOutcome::broken, "b was late");
  EXPECT_FALSE(record.open());
  EXPECT_EQ(done.version, 4U);
  EXPECT_EQ(done.reason, "b was late");
  ASSERT_EQ(done.activities.size(), 2U);
  const reactor::ExecutedActivity& a = done.activities[0];
  EXPECT_EQ(a.level, "primitive");
  EXPECT_EQ(a.state, ActivityState::succeeded);
  EXPECT_EQ(a.started, seconds(3));
  EXPECT_EQ(a.ended, seconds(9));
  EXPECT_EQ(a.attempts, 2U);
  EXPECT_EQ(a.cause, "at last");
  EXPECT_EQ(a.results.duration, seconds(6));
  EXPECT_EQ(a.results.energy_j, 11.0);
  EXPECT_EQ(a.results.values, (std::map<std::string, temporal::Value>{{"n", 2.0}, {"m", 7.0}}));
  EXPECT_EQ(done.activities[1].state, ActivityState::waiting);
}

TEST(ExecutionRecord, TheNextVersionKeepsWhatStandsInBoth) {
  ExecutionRecord record;
  record.begin(plan_of({"a", "b"}));
  record.note(
      executive::StepStatus{"b", "", 1, ActivityState::succeeded, {}, {}, seconds(3), seconds(4), ""});
  record.begin(plan_of({"c", "b"}));
  const reactor::ExecutedPlan done = record.close(ExecutedOutcome::finished, "");
  ASSERT_EQ(done.activities.size(), 2U);
  EXPECT_EQ(done.activities[0].state, ActivityState::waiting);
  EXPECT_EQ(done.activities[1].ended, seconds(4));
}

}  // namespace
}  // namespace roci::exec
