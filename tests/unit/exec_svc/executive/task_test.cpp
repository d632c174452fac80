// What a plan may say of a task beyond its command: a sequence of commands, a time for answers, a priority, a
// preferred start, that it fails alone (R67), and by when its owner must be done (R146).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/executive/scripted_world.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAction;
using executive::CommandStage;
using executive::Executive;
using executive::Outputs;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

/// The drill turns the arm, bores, and the arm is stowed.
PlanActivity& sample(PlanBuilder& b) {
  PlanActivity& activity = b.activity("sample", "arm", 60, 200);
  activity.command_name = "turn";
  activity.then = {{"drill", "", "drill", "bore", {{"depth", "0.1"}}, temporal::no_bound},
                   {"arm", "", "arm", "stow", {}, temporal::no_bound}};
  return activity;
}

TEST(Sequence, EachCommandFollowsTheEndOfTheOneBefore) {
  PlanBuilder b;
  sample(b);
  ScriptedWorld world(b.plan);
  world.answers("sample", {{.lasts = 10}, {.lasts = 30}, {.lasts = 20}});
  EXPECT_THAT(world.run(),
              ElementsAre("0 execute sample#1", "0 sample running", "10 sample running (command 2 of 3)",
                          "10 execute sample#2", "10 sample running (command 2 of 3)",
                          "40 sample running (command 3 of 3)", "40 execute sample#3",
                          "40 sample running (command 3 of 3)", "60 sample succeeded", "60 plan finished"));
}

TEST(Sequence, EachCommandGoesToItsOwner) {
  PlanBuilder b;
  sample(b);
  Executive executive;
  ASSERT_TRUE(executive.load(b.plan, {}).empty());
  std::vector<std::string> sent;
  const auto note = [&](const Outputs& outputs) {
    for (const Command& command : outputs.commands)
      sent.push_back(command.owner + " " + command.command_name + " " + std::to_string(command.attempt));
  };
  note(executive.step(seconds(0), {}));
  note(executive.step(seconds(10), {.acks = {{"sample", 1, CommandStage::completed, "", ""}}}));
  note(executive.step(seconds(30), {.acks = {{"sample", 2, CommandStage::completed, "", ""}}}));
  EXPECT_THAT(sent, ElementsAre("arm turn 1", "drill bore 2", "arm stow 3"));
}

TEST(Sequence, IsTriedAgainFromItsFirstCommand) {
  PlanBuilder b;
  sample(b).retries = 1;
  ScriptedWorld world(b.plan);
  world.answers(
      "sample",
      {{.lasts = 10}, {.lasts = 5, .ends_with = CommandStage::failed, .reason = "stuck"}, {.lasts = 20}});
  world.run();
  EXPECT_THAT(world.trace, IsSupersetOf({"10 execute sample#2", "15 execute sample#3", "35 execute sample#4",
                                         "55 execute sample#5", "75 sample succeeded"}));
  EXPECT_THAT(world.recoveries, ElementsAre(HasSubstr("15 retry sample: retry 1 of 1 after: failed: stuck")));
}

TEST(Sequence, ThatIsWithdrawnGoesNoFurther) {
  PlanBuilder b;
  sample(b);
  ScriptedWorld world(b.plan);
  world.answers("sample", {{.lasts = 10, .answers_cancel = false}});
  world.cancel_at(8);
  EXPECT_THAT(world.run(), AllOf(Not(Contains(HasSubstr("sample#2"))),
                                 Contains("10 sample cancelled (cancel requested)")));
}

TEST(Sequence, ThatMustBeTriedAgainGoesOnIfTheCommandEndedBeforeTheCancel) {
  PlanBuilder b;
  sample(b).retries = 1;
  Executive executive;
  ASSERT_TRUE(executive.load(b.plan, {}).empty());
  executive.step(seconds(0), {});
  const Outputs late = executive.step(seconds(6), {});  // its first answer is missing
  ASSERT_EQ(late.commands.at(0).action, CommandAction::cancel);
  const Outputs next = executive.step(seconds(7), {.acks = {{"sample", 1, CommandStage::completed, "", ""}}});
  ASSERT_EQ(next.commands.size(), 1U);
  EXPECT_EQ(next.commands[0].command_name, "bore");
}

TEST(Sequence, AnOwnerThatIsLostConcernsItsOwnCommandsAlone) {
  PlanBuilder b;
  sample(b);
  ScriptedWorld world(b.plan);
  world.answers("sample", {{.lasts = 10}, {.lasts = 30}, {.lasts = 20}});
  world.at(20, {.lost_owners = {"arm"}});
  world.at(45, {.lost_owners = {"drill"}});
  EXPECT_THAT(world.run(), Contains("60 plan finished"));
  ScriptedWorld other(b.plan);
  other.answers("sample", {{.lasts = 10}, {.lasts = 30}, {.lasts = 20}});
  other.at(20, {.lost_owners = {"drill"}});
  EXPECT_THAT(other.run(),
              Contains(HasSubstr("20 plan broken: activity_failed, sample, owner drill is lost")));
}

TEST(AnswerWithin, IsOfEachCommand) {
  PlanBuilder b;
  PlanActivity& activity = sample(b);
  activity.answer_within = seconds(2);
  activity.then[0].answer_within = seconds(30);
  Executive executive;
  ASSERT_TRUE(executive.load(b.plan, {}).empty());
  EXPECT_EQ(executive.step(seconds(0), {}).next_wake, seconds(2));
  executive.step(seconds(1), {.acks = {{"sample", 1, CommandStage::completed, "", ""}}});
  EXPECT_TRUE(executive.step(seconds(30.9), {}).commands.empty());
  const Outputs late = executive.step(seconds(31), {});
  EXPECT_EQ(late.commands.at(0).action, CommandAction::cancel);
  EXPECT_EQ(late.commands.at(0).owner, "drill");
  EXPECT_THAT(late.outcome.reason, HasSubstr("not answered by drill within 30 s"));
}

TEST(Priority, TheHigherOneStartsFirst) {
  PlanBuilder b;
  b.activity("first", "sim", 10);
  b.activity("second", "sim", 10).priority = 2;
  b.activity("third", "sim", 10).priority = 1;
  ScriptedWorld world(b.plan);
  world.run(0);
  world.trace.resize(3);
  EXPECT_THAT(world.trace, ElementsAre("0 execute second#1", "0 execute third#1", "0 execute first#1"));
}

TEST(PreferredStart, IsKeptAsFarAsTheWindowAllows) {
  PlanBuilder b;
  b.activity("early", "sim", 1).preferred_start = seconds(5);
  b.activity("inside", "sim", 1).preferred_start = seconds(30);
  b.activity("late", "sim", 1).preferred_start = seconds(90);
  for (const std::string id : {"early", "inside", "late"}) b.window(b.start(id), 20, 50);
  b.activity("open", "sim", 1).preferred_start = seconds(70);
  ScriptedWorld world(b.plan);
  EXPECT_THAT(world.run(), IsSupersetOf({"20 execute early#1", "30 execute inside#1", "50 execute late#1",
                                         "70 execute open#1", "71 plan finished"}));
}

TEST(PreferredStart, GivesWayWhenTheWindowShrinks) {
  PlanBuilder b;
  b.activity("drive", "sim", 10, 40);
  b.activity("look", "sim", 1).preferred_start = seconds(60);
  b.between(b.end("drive"), b.start("look"), 1, 20);
  ScriptedWorld world(b.plan);
  world.answers("drive", {{.lasts = 15}});
  EXPECT_THAT(world.run(), Contains("35 execute look#1"));
}

TEST(FailureScope, AnActivityFailsAloneAndThePlanGoesOn) {
  PlanBuilder b;
  b.activity("look", "camera", 10).failure = temporal::FailureScope::of_activity;
  b.activity("drive", "sim", 20);
  b.after("look", "drive");
  ScriptedWorld world(b.plan);
  world.answers("look", {{.lasts = 4, .ends_with = CommandStage::failed, .reason = "dust"}});
  EXPECT_THAT(world.run(), IsSupersetOf({"4 look failed (failed: dust; it fails alone)", "4 execute drive#1",
                                         "24 drive succeeded", "24 plan finished"}));
}

TEST(FailureScope, ItsOwnerIsAskedToStopFirst) {
  PlanBuilder b;
  PlanActivity& look = b.activity("look", "camera", 10);
  look.failure = temporal::FailureScope::of_activity;
  look.maintenance = compare("light", ConditionOp::gt, 1.0);
  b.activity("drive", "sim", 20);
  ScriptedWorld world(b.plan);
  world.observe(0, "light", 5.0);
  world.observe(3, "light", 0.0);
  EXPECT_THAT(world.run(), IsSupersetOf({"3 cancel look#1", "20 drive succeeded", "20 plan finished"}));
  EXPECT_THAT(world.trace, Contains(HasSubstr("3 look failed (maintenance condition broken")));
}

TEST(FailureScope, AMissedWaitFailsAloneAndADeadlineDoesNot) {
  PlanBuilder b;
  PlanActivity& look = b.activity("look", "camera", 10);
  look.failure = temporal::FailureScope::of_activity;
  look.lateness = temporal::LatenessPolicy::push;
  look.wait_timeout = seconds(5);
  look.pre = compare("light", ConditionOp::gt, 1.0);
  ScriptedWorld world(b.plan);
  world.observe(0, "light", 0.0);
  EXPECT_THAT(world.run(), IsSupersetOf({"5 plan finished"}));

  PlanBuilder d;
  PlanActivity& send = d.activity("send", "radio", 10, 20);
  send.failure = temporal::FailureScope::of_activity;
  send.lateness = temporal::LatenessPolicy::deadline;
  ScriptedWorld slow(d.plan);
  slow.answers("send", {{.lasts = 40}});
  EXPECT_THAT(slow.run(), Contains(HasSubstr("plan broken: deadline_passed")));
}

TEST(LatestEnd, IsTheDeadlineElseTheTimeAtWhichItCountsAsHung) {
  PlanBuilder b;
  b.activity("drive", "sim", 100);
  PlanActivity& send = b.activity("send", "radio", 10, 100);
  send.lateness = temporal::LatenessPolicy::deadline;
  b.window(b.end("send"), 0, 70);
  b.activity("listen", "radio", 1).duration_upper = temporal::no_bound;
  executive::ExecutiveSettings settings;
  settings.overrun_factor = 2;
  settings.overrun_grace = seconds(7);
  Executive executive(settings);
  ASSERT_TRUE(executive.load(b.plan, {}).empty());
  std::map<std::string, temporal::Time> told;
  for (const Command& command : executive.step(seconds(0), {}).commands)
    told[command.activity] = command.latest_end;
  EXPECT_EQ(told.at("drive"), seconds(207));
  EXPECT_EQ(told.at("send"), seconds(70) - temporal::Duration{1}) << "in time for what follows from it";
  EXPECT_EQ(told.at("listen"), temporal::no_bound);
}

}  // namespace
}  // namespace roci::exec::testing
