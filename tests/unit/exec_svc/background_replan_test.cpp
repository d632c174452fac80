// Replanning while what runs goes on.
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using goals::GoalClass;
using goals::GoalRecord;
using goals::GoalRequest;
using mission::Replanning;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::Reactor;
using temporal::Verdict;

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class BackgroundReplanning : public ReactorTest {
 protected:
  BackgroundReplanning() {
    mission.executive.replanning = Replanning::background;
    reactor = Reactor(mission);
    planner = [this](const PlanRequest& call) {
      problems.push_back(call.problem.text);
      origins.push_back(call.origin);
      std::vector<std::string> ids;
      for (const GoalRecord* goal : reactor.goals().open()) ids.push_back(goal->request.key.id);
      PlanReply reply = images_still_to_take(call, ids);
      for (temporal::PlanActivity& activity : reply.plan.activities) {
        const std::string image = activity.arguments.front().value;
        activity.impacts = {
            {"(have-image " + image + ")", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, true},
            {"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -800.0}};
      }
      return reply;
    };
  }

  static PlanReply images_still_to_take(const PlanRequest& call, const std::vector<std::string>& ids) {
    PlanReply out = reply(Verdict::solved);
    std::vector<std::string> missing;
    for (const std::string& id : ids)
      if (call.problem.text.find("(have-image image-" + id + ")") == std::string::npos) missing.push_back(id);
    out.plan = images(missing);
    return out;
  }

  void send(double at_s, GoalRequest goal) {
    other_events.emplace(seconds(at_s), [this, goal] { pending.goals.push_back(goal); });
  }

  // For four seconds a service is away that observes. The goal comes then, and the planner proves from what was seen
  // before that it is out of reach.
  void fly_while_an_observer_is_away(const GoalRequest& goal) {
    const Planner all = planner;
    planner = [this, all](const PlanRequest& call) {
      return observer_is_away ? reply(Verdict::unsolvable, "not enough of it") : all(call);
    };
    other_events.emplace(seconds(20), [this, goal] {
      observer_is_away = true;
      pending.losses = {{"map_svc", "cut off", true}};
      pending.goals.push_back(goal);
    });
    other_events.emplace(seconds(24), [this] {
      observer_is_away = false;
      pending.arrivals = {"map_svc"};
    });
    run(1000, robot_and({photo("1"), photo("2")}));
  }

  std::vector<std::string> codes_after(const std::string& first) const {
    return {std::find(trace.begin(), trace.end(), first), trace.end()};
  }

  bool observer_is_away = false;
  std::vector<std::string> problems;
  std::vector<Time> origins;
};

TEST_F(BackgroundReplanning, AGoalThatArrivesCancelsNothing) {
  planning_time = seconds(3);
  send(20, photo("2"));
  run(1000, robot_and({photo("1")}));
  EXPECT_THAT(trace, Not(Contains("cancel")));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().planner_calls, 2U);
  EXPECT_EQ(reactor.counts().replans, 1U);
  EXPECT_THAT(commands, ::testing::SizeIs(2));
}

// At 20 s, 15 of the image's 40 s have passed; 25/40 of its energy is still to come.
TEST_F(BackgroundReplanning, TheProblemIsOfTheStateThatIsLeft) {
  planning_time = seconds(0);
  send(20, photo("2"));
  run(1000, robot_and({photo("1")}));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_THAT(problems[0], Not(HasSubstr("(have-image image-1)\n")));
  EXPECT_THAT(problems[1], HasSubstr("(have-image image-1)\n"));
  EXPECT_THAT(problems[1], HasSubstr("(= (battery) 899500)"));
  EXPECT_EQ(origins[1], seconds(45));
}

TEST_F(BackgroundReplanning, NothingNewStartsBeforeTheAnswer) {
  planning_time = seconds(100);
  send(120, photo("3"));
  run(1000, robot_and({photo("1"), photo("2")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_THAT(trace, Not(Contains("cancel")));
  // The first image runs from 105 to 145 s; the second waits for the answer at 220 s and is in the new plan.
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands[1].activity.substr(0, 3), "p2.");
}

TEST_F(BackgroundReplanning, WhatDoesNotFitIsDroppedAndThePlanGoesOn) {
  const Planner all = planner;
  planner = [this, all](const PlanRequest& call) {
    return reactor.goals().open().size() > 2 ? reply(Verdict::unsolvable, "not enough of it") : all(call);
  };
  send(20, photo("3", GoalClass::opportunistic));
  run(1000, robot_and({photo("1"), photo("2")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().dropped, 1U);
  EXPECT_EQ(reactor.counts().planner_calls, 2U);
  EXPECT_THAT(trace, Contains("plan.kept"));
  EXPECT_EQ(reactor.plan_version(), 1U);
}

TEST_F(BackgroundReplanning, AHardGoalMayTakeThePlaceOfAnOptionalOne) {
  const Planner all = planner;
  planner = [this, all](const PlanRequest& call) {
    return reactor.goals().open().size() > 2 ? reply(Verdict::unsolvable, "not enough of it") : all(call);
  };
  send(20, photo("3"));
  run(1000, robot_and({photo("1"), photo("2", GoalClass::optional, 5)}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().dropped, 1U);
  EXPECT_EQ(reactor.counts().achieved, 2U);
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
  EXPECT_THAT(trace, Not(Contains("cancel")));
}

// A window may close before what runs has ended.
TEST_F(BackgroundReplanning, NoHardGoalIsGivenUpForWhatRuns) {
  const Planner all = planner;
  planner = [this, all](const PlanRequest& call) {
    return problems.size() == 1 && call.origin > now + mission.planner.allowance
               ? reply(Verdict::unsolvable, "too late")
               : all(call);
  };
  send(20, photo("2"));
  run(1000, robot_and({photo("1")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().failed, 0U);
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
  EXPECT_THAT(trace, Contains("cancel"));
}

// A command that no owner has answered may wait for leases still, and would begin after its recall was acknowledged.
TEST_F(BackgroundReplanning, WhatARecalledGoalHasCommandedAndNobodyAnsweredIsCancelled) {
  planning_time = seconds(0);
  robot_is_dead = true;
  other_events.emplace(seconds(6), [this] {
    robot_is_dead = false;
    GoalRequest recall = photo("1");
    recall.recalled = true;
    pending.goals.push_back(recall);
  });
  run(6.5, robot_and({photo("1"), photo("2")}));
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[1].action, executive::CommandAction::cancel);
  EXPECT_EQ(commands[1].activity, commands[0].activity);
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(BackgroundReplanning, WhatFailsMeanwhileLeadsToThePause) {
  planning_time = seconds(60);
  send(70, photo("2"));
  other_events.emplace(seconds(80), [this] { camera_works = false; });
  other_events.emplace(seconds(106), [this] { camera_works = true; });
  run(2000, robot_and({photo("1")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_THAT(trace, Contains("plan.broken"));
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
}

// The image is reported complete, but its state is not what the plan stands on.
TEST_F(BackgroundReplanning, AStateThatHasNotComeAboutIsPlannedAnew) {
  other_events.emplace(seconds(20), [this] {
    pending.goals.push_back(photo("2"));
    pending.observations.push_back({"rover.image.image-1", state("lost")});
  });
  camera_works = true;
  bool lied = false;
  const Planner all = planner;
  planner = [&, all](const PlanRequest& call) {
    PlanReply out = all(call);
    if (!std::exchange(lied, true))
      out.plan.activities.front().impacts.push_back(
          {"(camera-idle)", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, false});
    return out;
  };
  run(2000, robot_and({photo("1")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_THAT(codes_after("plan.wanted"), Contains("plan.wanted"));
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
}

TEST_F(BackgroundReplanning, ASecondGoalDuringTheCallIsPlannedWithIt) {
  planning_time = seconds(10);
  send(20, photo("2"));
  send(22, photo("3"));
  run(2000, robot_and({photo("1")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
  EXPECT_THAT(trace, Not(Contains("cancel")));
}

TEST_F(BackgroundReplanning, AnUnavailablePlannerLeadsToThePauseAndIsAskedAgain) {
  const Planner all = planner;
  int calls = 0;
  planner = [&, all](const PlanRequest& call) {
    return ++calls == 2 ? reply(Verdict::no_reply, "gone") : all(call);
  };
  send(20, photo("2"));
  run(2000, robot_and({photo("1")}));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(calls, 3);
}

// What runs goes on while a service is away that observes; its return asks again at once.
TEST_F(BackgroundReplanning, NoSoftGoalIsDroppedByAProofOfAnOldPicture) {
  fly_while_an_observer_is_away(photo("3", GoalClass::opportunistic));
  EXPECT_EQ(std::ranges::count(trace, "plan.retry"), 1);
  EXPECT_EQ(reactor.counts().dropped, 0U);
  EXPECT_EQ(reactor.counts().achieved, 3U);
  EXPECT_THAT(trace, Not(Contains("cancel")));
  EXPECT_EQ(reactor.counts().planner_calls, 3U);
}

// Its calls run out as those of a planner that fails, and the running plan starts its activities meanwhile.
TEST_F(BackgroundReplanning, AProofOfAnOldPictureIsBelievedInTheEnd) {
  mission.executive.call_retries = 2;  // after 10 s and 20 s
  reactor = Reactor(mission);
  const Planner all = planner;
  planner = [all](const PlanRequest& call) {
    return asks_for(call, "3") ? reply(Verdict::unsolvable, "not enough of it") : all(call);
  };
  other_events.emplace(seconds(20), [this] {
    pending.losses = {{"map_svc", "cut off", true}};
    pending.goals.push_back(photo("3", GoalClass::opportunistic));
  });
  run(1000, robot_and({photo("1"), photo("2")}));
  const auto last_call = std::find(trace.rbegin(), trace.rend(), "call").base();
  EXPECT_EQ(std::count(trace.begin(), last_call, "image"), 2) << "the second one starts before the last call";
  EXPECT_EQ(std::ranges::count(trace, "plan.retry"), 2);
  EXPECT_EQ(reactor.counts().dropped, 1U);
  EXPECT_EQ(reactor.counts().achieved, 2U);
  EXPECT_EQ(reactor.plan_version(), 1U);
  EXPECT_THAT(trace, Contains("plan.kept"));
}

// Nor is what runs cancelled for such a proof, where it speaks of a hard goal.
TEST_F(BackgroundReplanning, NothingIsCancelledByAProofOfAnOldPicture) {
  fly_while_an_observer_is_away(photo("3"));
  EXPECT_EQ(reactor.counts().achieved, 3U);
  EXPECT_THAT(trace, Not(Contains("cancel")));
}

// The proof and the change of the model that it does not know are heard in one step.
TEST_F(BackgroundReplanning, NoSoftGoalIsDroppedByAProofForAnOlderModel) {
  const Planner all = planner;
  bool changed = false;
  planner = [&, all](const PlanRequest& call) {
    if (reactor.goals().open().size() < 3 || std::exchange(changed, true)) return all(call);
    pending.models = {{"pathplan_svc", 2}};
    return reply(Verdict::unsolvable, "no way");
  };
  send(20, photo("3", GoalClass::opportunistic));
  reactor::ReactorInputs first = robot_and({photo("1"), photo("2")});
  first.models = {{"pathplan_svc", 1}};
  run(1000, std::move(first));
  EXPECT_EQ(reactor.counts().dropped, 0U);
  EXPECT_EQ(reactor.counts().achieved, 3U);
  EXPECT_THAT(trace, Contains("plan.outdated"));
}

}  // namespace
}  // namespace roci::exec::testing
