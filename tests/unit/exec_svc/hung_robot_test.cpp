// A robot that hangs through a pause is made safe, and goes on once it was seen to be safe.
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandStage;
using goals::GoalClass;
using reactor::MissionPhase;
using reactor::ReactorInputs;

namespace {

using ::testing::Contains;

class HungRobotTest : public ReactorTest {
 protected:
  // It hangs while it takes an image, and another goal asks for a pause that it does not hear.
  void hang_through_a_pause() {
    run(20, robot_and({photo("a")}));
    ASSERT_EQ(reactor.phase(), MissionPhase::executing);
    image = commands.back();
    robot_is_dead = true;
    robot_events.clear();
    ReactorInputs more;
    more.goals = {photo("b", GoalClass::opportunistic)};
    run(200, std::move(more));
    ASSERT_EQ(reactor.phase(), MissionPhase::safe);
    EXPECT_EQ(reactor.outcome(), "failed");
    robot_is_dead = false;
  }
  // What it says to all that it was asked meanwhile.
  ReactorInputs heard(CommandStage stage, const temporal::Value& camera) const {
    ReactorInputs out;
    out.acks.push_back({image.activity, image.attempt, CommandStage::cancelled, "", ""});
    for (const Command& command : commands)
      if (command.activity.starts_with(executive::kFallbackPrefix))
        out.acks.push_back({command.activity, command.attempt, stage, "", ""});
    out.observations = {{"rover.camera", camera}};
    return out;
  }

  Command image;
};

// Nobody has noticed it as lost, so it does not come back either.
TEST_F(HungRobotTest, GoesOnOnceItWasSeenToBeSafe) {
  hang_through_a_pause();
  run(300, heard(CommandStage::completed, state("imaging")));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe) << "it answers, and its camera still takes an image";
  ReactorInputs stopped;
  stopped.observations = {{"rover.camera", state("idle")}};
  run(1000, std::move(stopped));
  EXPECT_THAT(trace, Contains("robot.safe"));
  EXPECT_EQ(reactor.outcome(), "achieved");
  EXPECT_EQ(reactor.counts().achieved, 2U);
}

TEST_F(HungRobotTest, GoesOnAfterARestartOfTheExecutiveToo) {
  hang_through_a_pause();
  const std::string kept = reactor.snapshot();
  reactor::Reactor restarted{mission};
  restarted.restore(kept);
  std::swap(reactor, restarted);
  run(1000, heard(CommandStage::completed, state("idle")));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// It was heard, and did not stop: that is a fault of the robot, and the ground is waited for.
TEST_F(HungRobotTest, OneThatAnswersAndDoesNotStopWaitsForTheGround) {
  ReactorInputs inputs = robot_and({photo("a")});
  inputs.observations.push_back({"rover.camera", state("imaging")});
  run(200, std::move(inputs));
  ASSERT_EQ(reactor.phase(), MissionPhase::safe);
  ReactorInputs stopped;
  stopped.observations = {{"rover.camera", state("idle")}};
  run(1000, std::move(stopped));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_EQ(reactor.outcome(), "partial");
}

}  // namespace
}  // namespace roci::exec::testing
