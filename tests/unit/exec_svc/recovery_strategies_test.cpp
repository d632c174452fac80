// R102: one failure, four strategies and their cascade; the same plans come from the same generator.
#include "exec_svc/reactor/recovery_policy.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAction;
using executive::CommandStage;
using goals::GoalState;
using mission::RecoveryStrategy;
using reactor::Reactor;
using reactor::ReactorInputs;

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The camera fails `failures` times, then works. take-image has a retry and a contingency.
class Strategies : public ReactorTest {
 protected:
  void fly(RecoveryStrategy strategy, int failures) {
    mission.executive.recovery = strategy;
    mission.actions["take-image"].retries = 1;
    mission.actions["take-image"].contingency = "restart";
    mission.contingencies["restart"] = {
        "restart", {{"sim_svc", "camera", "restart", {}}}, true, 1, seconds(60)};
    reactor = Reactor(mission);
    failures_left = failures;
    run(3000, robot_and({photo("a")}));
  }

  void obey(const Command& command) override {
    if (command.command_name == "image" && command.action == CommandAction::execute)
      camera_works = failures_left-- <= 0;
    if (command.command_name == "restart") {
      commands.push_back(command);
      trace.push_back("restart");
      for (const auto stage : {CommandStage::accepted, CommandStage::completed})
        pending.acks.push_back({command.activity, command.attempt, stage, "", ""});
      return;
    }
    ReactorTest::obey(command);
  }

  int failures_left = 0;
};

TEST_F(Strategies, CascadeClimbsRungByRungAndEachIsTold) {
  fly(RecoveryStrategy::cascade, 1);
  EXPECT_THAT(trace, Contains("recovery.retry"));
  EXPECT_THAT(trace, Not(Contains("restart")));
  EXPECT_EQ(reactor.counts().planner_calls, 1U);  // R99: no replanning
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(Strategies, CascadeGoesOnWithTheContingencyThenWithThePlanner) {
  fly(RecoveryStrategy::cascade, 2);
  EXPECT_THAT(trace, Contains("recovery.contingency"));
  EXPECT_THAT(trace, Contains("restart"));
  EXPECT_EQ(reactor.counts().planner_calls, 1U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(Strategies, CascadeReplansWhenTheCheaperRungsAreUsedUp) {
  fly(RecoveryStrategy::cascade, 3);
  EXPECT_EQ(reactor.counts().planner_calls, 2U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(Strategies, StaticMendsNothingAndTheGoalFailsWithTheReason) {
  fly(RecoveryStrategy::as_planned, 1);
  EXPECT_THAT(trace, Not(Contains("recovery.retry")));
  EXPECT_EQ(reactor.counts().planner_calls, 1U);
  EXPECT_EQ(reactor.goals().find({"ground", "a"})->state, GoalState::failed);
  EXPECT_THAT(reasons["a"], HasSubstr("nothing is mended in this run"));
  EXPECT_EQ(reactor.outcome(), "partial");
}

TEST_F(Strategies, GroundIsAskedAtOnceAndItsNextGoalBringsAPlan) {
  fly(RecoveryStrategy::ground, 1);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(reactor.counts().planner_calls, 1U);
  EXPECT_THAT(reasons["a"], HasSubstr("waiting for the ground"));
  ReactorInputs reply;
  reply.goals = {photo("b")};
  run(6000, std::move(reply));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

TEST_F(Strategies, FlexibleExecutionTriesItsRungsThenAsksTheGround) {
  fly(RecoveryStrategy::flexible, 2);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(Strategies, FlexibleExecutionNeverCallsThePlannerForAFailure) {
  fly(RecoveryStrategy::flexible, 9);
  EXPECT_THAT(trace, Contains("restart"));
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(reactor.counts().planner_calls, 1U);
}

TEST_F(Strategies, ReplanSkipsTheCheaperRungs) {
  fly(RecoveryStrategy::replan, 1);
  EXPECT_THAT(trace, Not(Contains("recovery.retry")));
  EXPECT_THAT(trace, Not(Contains("restart")));
  EXPECT_EQ(reactor.counts().planner_calls, 2U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

}  // namespace
}  // namespace roci::exec::testing
