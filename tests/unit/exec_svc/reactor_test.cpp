// The reactor's way from goals to plans to achieved goals.
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using goals::GoalClass;
using goals::GoalRequest;
using goals::GoalState;
using reactor::MissionPhase;
using reactor::PlanRequest;
using reactor::ReactorInputs;
using temporal::Verdict;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(ReactorTest, GoalsAreAcceptedPlannedExecutedAchieved) {
  run(1000, robot_and({photo("a"), photo("b")}));
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "goal.accepted", "plan.wanted", "call", "plan.adopted",
                                 "image", "goal.achieved", "image", "goal.achieved", "plan.finished"));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().replans, 0U);
}

// A console's sender reads the answer; nobody reads that of a goal which a service of the run passes on.
TEST_F(ReactorTest, ARejectedHardGoalIsNotAchievedUnlessAConsoleSentIt) {
  GoalRequest bad = photo("bad");
  bad.kind = "photograph";
  run(1000, robot_and({photo("a"), bad}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().rejected, 1U);
  bad.key.id = "worse";
  bad.sample = {"sim_svc", 1, 7};
  run(2000, robot_and({bad}));
  EXPECT_EQ(reactor.outcome(), "partial");
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
  ASSERT_EQ(reactor.phase(), MissionPhase::executing);
  trace.clear();
  ReactorInputs more;
  more.goals = {photo("b", GoalClass::opportunistic)};
  run(1000, std::move(more));
  EXPECT_THAT(trace, ElementsAre("goal.accepted", "plan.wanted", "cancel", "call", "plan.adopted", "image",
                                 "goal.achieved", "image", "goal.achieved", "plan.finished"));
  EXPECT_EQ(reactor.counts().replans, 1U);
}

TEST_F(ReactorTest, WhenNotAllFitTheNewestOpportunisticGoesFirst) {
  planner = [this](const PlanRequest& call) {
    return reactor.goals().open().size() > 1 ? reply(Verdict::unsolvable, "too much")
                                             : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("first", GoalClass::opportunistic),
                       photo("second", GoalClass::opportunistic)}));
  EXPECT_EQ(reasons["second"],
            "no plan achieves all of hard, first, second; this one leaves first, as the newest opportunistic "
            "goal\ndetails: too much");
  EXPECT_EQ(reasons["first"],
            "no plan achieves all of hard, first; this one leaves first, as the newest opportunistic "
            "goal\ndetails: too much");
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().dropped, 2U);
}

// What one goal lacks is told of it alone; the planner's own words follow in a second line,
// and operators hear the first.
TEST_F(ReactorTest, AGoalOutOfReachSaysWhatItLacks) {
  planner = [this](const PlanRequest& call) {
    return testing::asks_for(call, "walled") ? blocked({"walled"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("free"), photo("walled", GoalClass::optional, 1)}));
  EXPECT_EQ(reasons["walled"], "out of reach: never reached\ndetails: never reached: (sent image-walled)");
}

TEST_F(ReactorTest, AGoalAloneIsNotSaidToBeOneOfMany) {
  planner = [](const PlanRequest&) { return reply(Verdict::unsolvable, "too much"); };
  run(1000, robot_and({photo("only", GoalClass::optional, 1)}));
  EXPECT_EQ(reasons["only"], "no plan achieves it\ndetails: too much");
}

// The planner refuses every problem with the impossible goal and blames none. The others leave before it, and nobody
// says of one of them, or of the impossible one, what it would be alone; once it is alone, the planner has said it.
TEST_F(ReactorTest, WhereNoGoalIsBlamedNothingIsSaidOfOneAlone) {
  planner = [this](const PlanRequest& call) {
    return testing::asks_for(call, "impossible") ? reply(Verdict::unsolvable, "too much")
                                                 : image_every_goal(call);
  };
  run(1000, robot_and({photo("impossible"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_EQ(
      reasons["soft"],
      "no plan achieves all of impossible, soft; this one leaves first, as the optional goal of the lowest "
      "utility\ndetails: too much");
  EXPECT_EQ(reasons["impossible"], "no plan achieves it\ndetails: too much");
}

TEST_F(ReactorTest, OneImpossibleGoalThatIsNotBlamedMayTakeAnotherHardOneWithIt) {
  planner = [this](const PlanRequest& call) {
    return testing::asks_for(call, "impossible") ? reply(Verdict::unsolvable, "too much")
                                                 : image_every_goal(call);
  };
  run(1000, robot_and({photo("impossible"), photo("fine")}));
  EXPECT_EQ(reasons["fine"],
            "no plan achieves all of impossible, fine; this one leaves first, as the newest hard "
            "goal\ndetails: too "
            "much");
  EXPECT_EQ(reasons["impossible"], "no plan achieves it\ndetails: too much");
}

// The soft goals are no part of the second call, so the reason does not name them.
TEST_F(ReactorTest, AReasonNamesTheGoalsOfTheCallAlone) {
  planner = [this](const PlanRequest& call) {
    if (testing::asks_for(call, "soft")) return blocked({"first"});
    return testing::asks_for(call, "second") ? reply(Verdict::unsolvable, "too much")
                                             : image_every_goal(call);
  };
  run(1000, robot_and({photo("first"), photo("second"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_THAT(reasons["second"], ::testing::StartsWith("no plan achieves all of first, second; this one"));
}

// The planner thinks that it is done, and no observation says so: not 50 plans, but two.
TEST_F(ReactorTest, APlanWithoutActivitiesIsAdoptedOnceForAnOpenGoal) {
  planner = [](const PlanRequest&) { return reply(Verdict::solved); };
  run(1000, robot_and({photo("ghost"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "plan.adopted"), 1);
  EXPECT_EQ(reactor.goals().find({"ground", "ghost"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "soft"})->state, GoalState::dropped);
  EXPECT_THAT(reasons["ghost"], ::testing::HasSubstr("nothing that is observed says so"));
  EXPECT_EQ(reactor.outcome(), "partial");
}

// Plans that break at the same place, with nothing done in between, wait longer and longer,
// and are given up in the end.
TEST_F(ReactorTest, EqualBreaksInARowPauseLikeEqualFailures) {
  std::vector<double> calls;
  planner = [&](const PlanRequest& call) {
    calls.push_back(temporal::to_seconds(now));
    if (!testing::asks_for(call, "b")) return image_every_goal(call);
    auto out = reply(Verdict::solved);
    out.plan = testing::images({"a", "b"});
    // The second image asks for more than there is as soon as the first one runs: the plan breaks at once.
    out.plan.activities[0].impacts = {
        {"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -1.0}};
    out.plan.activities[1].pre = temporal::compare("(battery)", temporal::ConditionOp::ge, 1e7);
    return out;
  };
  run(5000, robot_and({photo("a"), photo("b")}));
  ASSERT_EQ(calls.size(), mission.executive.failure_limit + 1) << "the last one without b";
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::achieved);
  EXPECT_LT(calls[1] - calls[0], 6) << "the first break is followed by a plan at once";
  EXPECT_NEAR(calls[2] - calls[1], 30, 6);
  EXPECT_NEAR(calls[3] - calls[2], 60, 6);
  EXPECT_THAT(reasons["b"], ::testing::HasSubstr("8 plans in a row broke at take-image"));
}

TEST_F(ReactorTest, ASpentBudgetDropsTooAndIsReportedAsWhatItIs) {
  planner = [this](const PlanRequest& call) {
    return reactor.goals().open().size() > 1 ? reply(Verdict::timeout) : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("soft", GoalClass::optional, 1)}));
  EXPECT_THAT(
      reasons["soft"],
      ::testing::MatchesRegex("no plan was found within the planner's budget of [0-9]+ evaluations.*: .+ "
                              "\\(x 110, y 60\\), together with hard\ndetails: timeout"));
}

// What an owner of functions did not find is no proof, and yet says which goal stands in the way.
TEST_F(ReactorTest, AGoalThatStandsOnAnUnknownValueLeavesAndNoOther) {
  planner = [this](const PlanRequest& call) {
    if (!testing::asks_for(call, "misty")) return image_every_goal(call);
    auto out = blocked({"misty"});
    out.verdict = Verdict::timeout;
    out.blocking[0].reason = "no way to place-misty is known: pathplan_svc found none";
    out.reason = "not known: pathplan_svc found no way";
    return out;
  };
  run(1000, robot_and({photo("misty", GoalClass::optional, 9), photo("free", GoalClass::optional, 1),
                       photo("late", GoalClass::opportunistic)}));
  EXPECT_EQ(reasons["misty"],
            "not known: no way to place-misty is known: pathplan_svc found none\ndetails: not known: "
            "pathplan_svc found no way");
  EXPECT_EQ(reactor.goals().find({"ground", "free"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "late"})->state, GoalState::achieved);
}

// Where nobody says why, the goal itself is told, not how planners work.
TEST_F(ReactorTest, AGoalThatNoPlanBringsAboutIsToldAsItWasAskedFor) {
  planner = [this](const PlanRequest& call) {
    if (!testing::asks_for(call, "walled")) return image_every_goal(call);
    auto out = blocked({"walled"});
    out.blocking[0].reason.clear();
    return out;
  };
  run(1000, robot_and({photo("free"), photo("walled", GoalClass::optional, 1)}));
  EXPECT_THAT(reasons["walled"],
              ::testing::MatchesRegex("out of reach: no plan brings it about: .+ \\(x 110, y 60\\)\ndetails: "
                                      "never reached: \\(sent image-walled\\)"));
}

TEST_F(ReactorTest, AHardGoalThatThePlannerNamesFailsAndTheRestGoesOn) {
  planner = [this](const PlanRequest& call) {
    return testing::asks_for(call, "walled") ? blocked({"walled"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("walled"), photo("free")}));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "free"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "partial");
}

TEST_F(ReactorTest, WhatThePlannerProvesOutOfReachTakesNothingElseWithIt) {
  planner = [this](const PlanRequest& call) {
    return testing::asks_for(call, "walled") ? blocked({"walled"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("free", GoalClass::opportunistic), photo("walled", GoalClass::optional, 9),
                       photo("cheap", GoalClass::optional, 1)}));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::dropped);
  EXPECT_EQ(reactor.goals().find({"ground", "free"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.goals().find({"ground", "cheap"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// A search under the demands of all goals says nothing of one alone: without the soft ones the planner tells.
TEST_F(ReactorTest, AHardGoalThatFitsWithoutTheSoftOnesStays) {
  planner = [this](const PlanRequest& call) {
    const bool soft = testing::asks_for(call, "late");
    return soft ? blocked({"hard"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("hard"), photo("soft", GoalClass::optional, 9),
                       photo("late", GoalClass::opportunistic)}));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "call"), 3);
  EXPECT_EQ(reasons["late"],
            "no plan has the hard goals beside it\ndetails: never reached: (sent image-hard)");
  EXPECT_EQ(reactor.goals().find({"ground", "soft"})->state, GoalState::achieved);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(ReactorTest, AHardGoalOutOfReachTakesNoSoftOneWithIt) {
  planner = [this](const PlanRequest& call) {
    const bool hard = testing::asks_for(call, "walled");
    return hard ? blocked({"walled"}) : image_every_goal(call);
  };
  run(1000, robot_and({photo("walled"), photo("soft", GoalClass::opportunistic)}));
  EXPECT_EQ(reactor.goals().find({"ground", "walled"})->state, GoalState::failed);
  EXPECT_EQ(reactor.goals().find({"ground", "soft"})->state, GoalState::achieved);
}

// What is kept back is for hard goals: spent before one is given up, and kept again when another goal comes.
TEST_F(ReactorTest, ReservesAreSpentBeforeAHardGoalIsGivenUp) {
  std::vector<std::string> asked;
  planner = [&](const PlanRequest& call) {
    const bool kept = call.problem.text.find("(= (reserve) 20000)") != std::string::npos;
    asked.push_back(kept ? "kept" : "spent");
    if (kept) return blocked({"hard"});
    return image_every_goal(call);
  };
  run(20, robot_and({photo("hard")}));
  EXPECT_EQ(asked, (std::vector<std::string>{"kept", "spent"}));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "reserve.spent"), 1);
  EXPECT_EQ(reactor.goals().find({"ground", "hard"})->state, GoalState::planned);
  ReactorInputs more;
  more.goals = {photo("far")};
  asked.clear();
  planner = [&](const PlanRequest& call) {
    asked.push_back(call.problem.text.find("(= (reserve) 5000)") != std::string::npos ? "spent" : "kept");
    return blocked({"far"});
  };
  run(30, std::move(more));
  ASSERT_GE(asked.size(), 3U);
  EXPECT_EQ(asked[0], "kept");
  EXPECT_EQ(asked[1], "spent");
  EXPECT_EQ(asked[2], "kept") << "for the goals that remain";
  EXPECT_EQ(reactor.goals().find({"ground", "far"})->state, GoalState::failed);
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
  planner = [&](const PlanRequest& call) {
    return there ? image_every_goal(call) : reply(Verdict::no_reply, "no planner_svc");
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
  EXPECT_EQ(reactor.phase(), MissionPhase::finished);
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
  planner = [this](const PlanRequest& call) { return image_every_goal(call); };
  run(1000, robot_and({photo("a")}));
  ReactorInputs stale;
  stale.reply = reply(Verdict::unsolvable);
  stale.reply->call = 999;
  run(1100, std::move(stale));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

}  // namespace
}  // namespace roci::exec::testing
