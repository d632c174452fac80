// The robot is safe when it was seen to be: every fall-back answered, every component observed inactive.
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec {
namespace {

using namespace testing;
using executive::Command;
using executive::CommandAck;
using executive::CommandStage;
using reactor::ReactorInputs;
using ::testing::Contains;
using ::testing::Not;

class SafingTest : public ReactorTest {
 protected:
  SafingTest() { mission.executive.fallback_timeout = seconds(60); }

  // Stops are answered and obeyed only as far as the test says.
  void obey(const Command& command) override {
    if (!command.activity.starts_with(executive::kFallbackPrefix)) return ReactorTest::obey(command);
    fallbacks.push_back(command);
    if (refuse_epochs > 0) {
      --refuse_epochs;
      CommandAck refused{command.activity, 1, CommandStage::rejected, "old-epoch", ""};
      refused.epoch = command.epoch;
      refused.refused_epoch = true;
      pending.acks.push_back(refused);
      pending.epoch = command.epoch + 4;
      return;
    }
    if (answers) pending.acks.push_back({command.activity, 1, answer, "done", ""});
    if (stops) pending.observations.push_back({"rover.nav", state("idle-at", {"here"})});
  }

  // A rover that drives although nobody has commanded it, and an order to make it safe.
  ReactorInputs driving() {
    ReactorInputs inputs = robot_and({});
    inputs.observations.push_back({"rover.nav", state("going-to", {"ridge"})});
    inputs.epoch = 3;
    inputs.ground_orders.push_back(safe("safe"));
    return inputs;
  }
  static orders::Order safe(const std::string& id) {
    orders::Order order;
    order.key = {"ground", id};
    order.kind = orders::OrderKind::safe;
    return order;
  }
  orders::OrderStage stage_of(const std::string& id) const {
    const auto newest = std::ranges::find(order_stages.rbegin(), order_stages.rend(), id,
                                          [](const orders::OrderStatus& status) { return status.key.id; });
    return newest->stage;
  }

  bool answers = true;
  CommandStage answer = CommandStage::completed;
  bool stops = true;
  int refuse_epochs = 0;
  std::vector<Command> fallbacks;
};

TEST_F(SafingTest, ItIsSaidWhenItWasSeenAndNotBefore) {
  stops = false;
  now = seconds(0);
  run(30, driving());
  EXPECT_THAT(trace, Contains("robot.safing"));
  EXPECT_THAT(trace, Not(Contains("robot.safe"))) << "the owner has answered, but the rover drives on";
  ReactorInputs stopped;
  stopped.observations.push_back({"rover.nav", state("idle-at", {"here"})});
  run(40, stopped);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(std::ranges::count(trace, "robot.safe"), 1);
}

TEST_F(SafingTest, AnObservationAloneIsNotTheOwnersWord) {
  answers = false;
  mission.executive.round_trips["sim_svc"] = seconds(2);
  run(3, driving());
  EXPECT_THAT(trace, Not(Contains("robot.safe")));
  answers = true;
  run(30, {});  // it is behind a link, so the fall-back is sent again, under its key
  EXPECT_THAT(trace, Contains("robot.safe"));
  ASSERT_EQ(fallbacks.size(), 2U);
  EXPECT_EQ(fallbacks[1].activity, fallbacks[0].activity);
  EXPECT_EQ(fallbacks[1].epoch, fallbacks[0].epoch);
}

TEST_F(SafingTest, ARobotThatDoesNotStopIsToldOfAndSafeLater) {
  stops = false;
  run(100, driving());
  EXPECT_EQ(std::ranges::count(trace, "robot.unsafe"), 1);
  EXPECT_THAT(trace, Not(Contains("robot.safe")));
  ReactorInputs stopped;
  stopped.observations.push_back({"rover.nav", state("idle-at", {"here"})});
  run(110, stopped);
  EXPECT_EQ(trace.back(), "robot.safe");
}

TEST_F(SafingTest, AFallbackThatWasRefusedForItsEpochIsSentInTheNext) {
  refuse_epochs = 1;
  run(30, driving());
  ASSERT_EQ(fallbacks.size(), 2U);
  EXPECT_GT(fallbacks[1].epoch, fallbacks[0].epoch);
  EXPECT_EQ(trace.back(), "robot.safe");
}

TEST_F(SafingTest, ARobotAtRestIsSafeAtOnce) {
  ReactorInputs inputs = driving();
  inputs.observations.back() = {"rover.nav", state("idle-at", {"here"})};
  run(1, inputs);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_THAT(fallbacks, ::testing::IsEmpty());
  EXPECT_THAT(trace, Not(Contains("robot.safing")));
}

TEST_F(SafingTest, AnOwnerThatComesBackIsToldToStopAgain) {
  stops = answers = false;
  run(30, driving());
  const std::size_t before = fallbacks.size();
  stops = answers = true;
  ReactorInputs back;
  back.arrivals = {"sim_svc"};
  run(40, back);
  EXPECT_EQ(fallbacks.size(), before + 1);
  EXPECT_NE(fallbacks.back().activity, fallbacks.front().activity);
  EXPECT_EQ(trace.back(), "robot.safe");
}

TEST_F(SafingTest, OrderedAgainAFailedFallbackIsTriedAgain) {
  stops = false;
  answer = CommandStage::failed;
  run(100, driving());
  EXPECT_THAT(trace, Contains("fallback.failed"));
  EXPECT_THAT(trace, Not(Contains("robot.safe")));
  stops = true;
  answer = CommandStage::completed;
  ReactorInputs again;
  again.ground_orders.push_back(safe("again"));
  run(110, again);
  ASSERT_EQ(fallbacks.size(), 2U);
  EXPECT_NE(fallbacks[1].activity, fallbacks[0].activity);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(stage_of("safe"), orders::OrderStage::applied);
  EXPECT_EQ(stage_of("again"), orders::OrderStage::applied);
}

TEST_F(SafingTest, OrderedAgainWhatHasBecomeActiveIsStopped) {
  run(30, driving());
  ASSERT_EQ(trace.back(), "robot.safe");
  ReactorInputs again;
  again.observations.push_back({"rover.nav", state("going-to", {"ridge"})});
  again.ground_orders.push_back(safe("again"));
  run(40, again);
  EXPECT_EQ(fallbacks.size(), 2U);
  EXPECT_EQ(trace.back(), "robot.safe");
  EXPECT_EQ(stage_of("again"), orders::OrderStage::applied);
}

TEST_F(SafingTest, OrderedAgainAFallbackThatIsNotAnsweredIsAwaited) {
  stops = answers = false;
  run(3, driving());
  ReactorInputs again;
  again.ground_orders.push_back(safe("again"));
  run(4, again);
  EXPECT_EQ(fallbacks.size(), 1U) << "beside another one it could be refused";
}

TEST_F(SafingTest, AnotherExecutivesAnswerIsNone) {
  answers = false;
  run(3, driving());
  ReactorInputs foreign;
  foreign.acks.push_back({fallbacks.front().activity, 1, CommandStage::completed, "done", "", 2});
  run(4, foreign);
  EXPECT_THAT(trace, Not(Contains("robot.safe"))) << "its key has another epoch";
  foreign.acks.front().epoch = 3;
  run(5, foreign);
  EXPECT_EQ(trace.back(), "robot.safe");
}

}  // namespace
}  // namespace roci::exec
