// The reactor against scripted worlds: a stand-in planner answers its calls, a stand-in robot its commands.
#include "exec_svc/reactor/reactor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {
namespace {

using temporal::seconds;
using temporal::state;
using temporal::Time;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::photo;

// One image per planned goal: enough for the reactor, which knows nothing of planning.
temporal::FlexiblePlan images(const std::vector<std::string>& ids) {
  temporal::FlexiblePlan plan;
  for (const std::string& id : ids) {
    temporal::PlanActivity activity;
    activity.id = "a" + id;
    activity.name = "take-image";
    activity.arguments = {{"1", "image-" + id}, {"2", "place-" + id}};
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    activity.duration_lower = activity.duration_upper = seconds(40);
    if (!plan.activities.empty()) {
      plan.constraints.push_back({plan.activities.back().end_point, activity.start_point,
                                  temporal::ConstraintKind::ordering, seconds(0.001), temporal::no_bound});
    }
    plan.activities.push_back(std::move(activity));
  }
  return plan;
}

class ReactorTest : public ::testing::Test {
 protected:
  // The answer to a planner call; by default a plan with an image of every goal in the problem.
  using Planner = std::function<PlanAnswer(const PlanCall&)>;

  void run(double until_s, ReactorInputs inputs) {
    pending = std::move(inputs);
    for (int turns = 0; turns < 10000; ++turns) {
      const ReactorInputs now_inputs = std::exchange(pending, {});
      const ReactorOutputs out = reactor.step(now, now_inputs);
      take(out);
      if (!is_empty(pending)) continue;
      Time next = seconds(until_s);
      if (out.wake && *out.wake > now) next = std::min(next, *out.wake);
      for (const auto& [time, event] : robot_events) next = std::min(next, time);
      if (out.wake && *out.wake <= now) continue;
      if (next >= seconds(until_s)) break;
      now = next;
      while (!robot_events.empty() && robot_events.begin()->first <= now) {
        robot_events.begin()->second();
        robot_events.erase(robot_events.begin());
      }
    }
  }

  static bool is_empty(const ReactorInputs& inputs) {
    return inputs.goals.empty() && inputs.observations.empty() && inputs.acks.empty() &&
           inputs.losses.empty() && !inputs.answer;
  }

  void take(const ReactorOutputs& out) {
    for (const Note& note : out.notes) trace.push_back(note.code);
    for (const GoalRecord& goal : out.goal_changes) reasons[goal.request.key.id] = goal.reason;
    if (out.call) {
      trace.push_back("call");
      pending.answer = planner(*out.call);
      pending.answer->call = out.call->id;
    }
    for (const Command& command : out.commands) obey(command);
  }

  void obey(const Command& command) {
    if (command.action == CommandAction::cancel) {
      trace.push_back("cancel");
      robot_events.clear();
      pending.acks.push_back({command.activity, command.attempt, CommandStage::cancelled, "", ""});
      pending.observations.push_back({"rover.camera", state("idle")});
      return;
    }
    trace.push_back(command.command_name);
    pending.acks.push_back({command.activity, command.attempt, CommandStage::accepted, "", ""});
    if (command.command_name != "image") return;
    pending.observations.push_back({"rover.camera", state("imaging")});
    const std::string image = command.arguments.front().value;
    robot_events.emplace(now + camera_time, [this, command, image] {
      pending.observations.push_back({"rover.camera", state("idle")});
      if (camera_works) pending.observations.push_back({"image." + image, state("sent")});
      const auto stage = camera_works ? CommandStage::completed : CommandStage::failed;
      pending.acks.push_back({command.activity, command.attempt, stage, "", "shutter"});
    });
  }

  ReactorInputs robot_and(std::vector<GoalRequest> goals) {
    ReactorInputs inputs;
    inputs.observations = testing::standing_robot();
    inputs.goals = std::move(goals);
    return inputs;
  }

  static PlanAnswer answer(PlanVerdict verdict, std::string reason = "") {
    PlanAnswer out;
    out.verdict = verdict;
    out.reason = std::move(reason);
    return out;
  }

  PlanAnswer image_every_goal(const PlanCall& call) {
    PlanAnswer out = answer(PlanVerdict::solved);
    std::vector<std::string> ids;
    for (const GoalRecord* goal : reactor.goals().open()) ids.push_back(goal->request.key.id);
    EXPECT_THAT(call.problem.text, HasSubstr("(:goal"));
    out.plan = images(ids);
    return out;
  }

  MissionModel mission = testing::planetary();
  Reactor reactor{mission};
  Time now{0};
  Time camera_time = seconds(40);
  bool camera_works = true;
  Planner planner = [this](const PlanCall& call) { return image_every_goal(call); };
  ReactorInputs pending;
  std::multimap<Time, std::function<void()>> robot_events;
  std::vector<std::string> trace;
  std::map<std::string, std::string> reasons;
};

TEST_F(ReactorTest, GoalsAreAcceptedPlannedExecutedAchieved) {
  run(1000, robot_and({photo("a"), photo("b")}));
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "goal.accepted", "plan.wanted", "call", "plan.adopted",
                                 "image", "goal.achieved", "image", "goal.achieved", "plan.finished"));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().replans, 0U);
}

TEST_F(ReactorTest, WaitsForTheFirstObservationOfEveryComponent) {
  ReactorInputs inputs = robot_and({photo("a")});
  inputs.observations.erase(inputs.observations.begin());  // rover.nav
  run(100, std::move(inputs));
  EXPECT_EQ(reactor.counts().planner_calls, 0U);
  ReactorInputs rest;
  rest.observations = {testing::standing_robot().front()};
  run(1000, std::move(rest));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, AGoalInFlightPausesFallsBackPlansAndResumes) {
  run(20, robot_and({photo("a")}));
  ASSERT_EQ(reactor.phase(), Phase::executing);
  trace.clear();
  ReactorInputs more;
  more.goals = {photo("b", GoalClass::opportunistic)};
  run(1000, std::move(more));
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "plan.wanted", "cancel", "call", "plan.adopted", "image",
                                 "goal.achieved", "image", "goal.achieved", "plan.finished"));
  EXPECT_EQ(reactor.counts().replans, 1U);
}

TEST_F(ReactorTest, WhenNotAllFitTheNewestOpportunisticGoesFirst) {
  planner = [this](const PlanCall& call) {
    return reactor.goals().open().size() > 1 ? answer(PlanVerdict::unsolvable, "too much")
                                             : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("first", GoalClass::opportunistic),
                       photo("second", GoalClass::opportunistic)}));
  EXPECT_EQ(reasons["second"], "proved that not all goals fit: too much");
  EXPECT_EQ(reasons["first"], "proved that not all goals fit: too much");
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().dropped, 2U);
}

TEST_F(ReactorTest, ASpentBudgetDropsTooAndIsReportedAsWhatItIs) {
  planner = [this](const PlanCall& call) {
    return reactor.goals().open().size() > 1 ? answer(PlanVerdict::timeout) : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_EQ(reasons["soft"], "timeout");
}

TEST_F(ReactorTest, AHardGoalThatThePlannerNamesFailsAndTheRestGoesOn) {
  planner = [this](const PlanCall& call) {
    return call.problem.text.find("(sent image-walled)\n  ") != std::string::npos
               ? answer(PlanVerdict::unsolvable, "goal (sent image-walled) can never be reached")
               : image_every_goal(call);
  };
  run(1000, robot_and({photo("walled"), photo("free")}));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "free"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "partial");
}

TEST_F(ReactorTest, WhatThePlannerProvesOutOfReachTakesNothingElseWithIt) {
  planner = [this](const PlanCall& call) {
    return call.problem.text.find("(sent image-walled)\n  ") != std::string::npos
               ? answer(PlanVerdict::unsolvable, "goal (sent image-walled) can never be reached")
               : image_every_goal(call);
  };
  run(1000, robot_and({photo("free", GoalClass::opportunistic), photo("walled", GoalClass::optional, 9),
                       photo("cheap", GoalClass::optional, 1)}));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::dropped);
  EXPECT_EQ(reactor.goals().find({"ground", "free"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "cheap"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, AChangeThatIsRefusedLeavesGoalAndPlanAsTheyWere) {
  run(20, robot_and({photo("a")}));
  trace.clear();
  ReactorInputs inputs;
  inputs.goals = {photo("a")};
  inputs.goals[0].arguments["x"] = "far";
  run(1000, std::move(inputs));
  EXPECT_THAT(trace, ElementsAre("goal.refused", "goal.achieved", "plan.finished"));
}

TEST_F(ReactorTest, ABrokenPlanIsReplannedUntilTheLimitThenTheRobotIsSafe) {
  camera_works = false;
  mission.executive.replan_limit = 3;
  run(5000, robot_and({photo("a")}));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.broken"), 4);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(reactor.outcome(), "partial");
  EXPECT_THAT(reasons["a"], HasSubstr("the limit of 3 replans is reached"));
}

TEST_F(ReactorTest, AMissingPlannerIsAskedAgainLaterAndAComingBackAtOnce) {
  bool there = false;
  planner = [&](const PlanCall& call) {
    return there ? image_every_goal(call) : answer(PlanVerdict::no_reply, "no planner_svc");
  };
  run(25, robot_and({photo("a")}));
  EXPECT_THAT(trace, Contains("plan.retry"));
  EXPECT_EQ(reactor.goals().open().size(), 1U);  // nothing is lost
  there = true;
  run(2000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, RecallOfTheOnlyGoalStopsTheRobot) {
  run(20, robot_and({photo("a")}));
  GoalRequest recall = photo("a");
  recall.recalled = true;
  ReactorInputs inputs;
  inputs.goals = {recall};
  run(1000, std::move(inputs));
  EXPECT_THAT(trace, Contains("cancel"));
  EXPECT_EQ(reactor.phase(), Phase::finished);
  EXPECT_EQ(reactor.counts().achieved, 0U);
}

TEST_F(ReactorTest, ARejectedGoalDoesNotSpoilTheMission) {
  GoalRequest bad = photo("b");
  bad.arguments["x"] = "far";
  run(1000, robot_and({photo("a"), bad}));
  EXPECT_EQ(reactor.goals().find({"ground", "b"})->state, GoalState::rejected);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, AnAnswerToAStaleCallIsIgnored) {
  planner = [this](const PlanCall& call) { return image_every_goal(call); };
  run(1000, robot_and({photo("a")}));
  ReactorInputs stale;
  stale.answer = answer(PlanVerdict::unsolvable);
  stale.answer->call = 999;
  run(1100, std::move(stale));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

}  // namespace
}  // namespace roci::exec
