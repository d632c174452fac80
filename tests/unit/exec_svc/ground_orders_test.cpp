// Orders of the ground: what each does, when it is refused and in which words, that it is given once, and
// what a snapshot keeps of it.

#include "core/bytes/crc_32.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using mission::AutonomyLevel;
using orders::Order;
using orders::OrderKind;
using orders::OrderStage;
using orders::OrderStatus;
using reactor::MissionPhase;
using reactor::Reactor;

namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr char kWipe[] =
    "commands: [{owner: sim_svc, component: camera, command: image, arguments: {image: wiped}}]\nthen: "
    "retry\n";

class OrderTest : public ReactorTest {
 protected:
  OrderTest() {
    mission.ground = {{"rover.go"}, {"contingencies.wipe"}};
    mission.contingencies["wipe"] = {"wipe", {{"sim_svc", "camera", "stop", {}}}, false};
    reactor = Reactor(mission);
  }

  static Order order(OrderKind kind, const std::string& target = "") {
    Order out;
    out.kind = kind;
    out.target = target;
    return out;
  }
  static Order level(AutonomyLevel level) {
    Order out = order(OrderKind::autonomy);
    out.level = level;
    return out;
  }
  static Order uploaded(const std::string& target, const std::string& text) {
    Order out = order(OrderKind::upload, target);
    out.upload = text;
    out.checksum = bytes::crc_32(text);
    return out;
  }
  Order numbered(Order one) {
    one.key = {"ground", std::to_string(++given)};
    one.sample = {"roci", 0, static_cast<std::uint64_t>(given)};
    return one;
  }
  void at(double time_s, Order one) {
    other_events.emplace(seconds(time_s),
                         [this, one = numbered(std::move(one))] { pending.ground_orders.push_back(one); });
  }
  // Stages of the order with this number, in their order.
  std::vector<OrderStage> stages(int number) const {
    std::vector<OrderStage> out;
    for (const OrderStatus& status : order_stages)
      if (status.key.id == std::to_string(number)) out.push_back(status.stage);
    return out;
  }
  std::string reason(int number) const {
    std::string out;
    for (const OrderStatus& status : order_stages)
      if (status.key.id == std::to_string(number)) out = status.reason;
    return out;
  }
  // A cancel that is not heard leaves the camera at work.
  void obey(const executive::Command& command) override {
    if (hears_cancels || command.action != executive::CommandAction::cancel)
      return ReactorTest::obey(command);
    commands.push_back(command);
  }
  static Order image(const std::string& name) {
    Order out = order(OrderKind::command, "camera");
    out.content = state("image", {"image=" + name});
    return out;
  }
  std::vector<std::string> images_begun() const {
    std::vector<std::string> out;
    for (const executive::Command& command : commands)
      if (command.action == executive::CommandAction::execute && command.command_name == "image")
        out.push_back(command.arguments.front().value);
    return out;
  }

  static inline const std::vector<OrderStage> kApplied{OrderStage::received, OrderStage::accepted,
                                                       OrderStage::applied};
  static inline const std::vector<OrderStage> kRefused{OrderStage::received, OrderStage::refused};
  static inline const std::vector<OrderStage> kAccepted{OrderStage::received, OrderStage::accepted};
  int given = 0;
  bool hears_cancels = true;
};

TEST_F(OrderTest, HoldStartsNothingNewAndReleaseGoesOn) {
  at(20, order(OrderKind::hold));
  run(400, robot_and({photo("1"), photo("2")}));
  EXPECT_EQ(stages(1), kApplied);
  EXPECT_TRUE(reactor.held());
  EXPECT_THAT(images_begun(), ElementsAre("image-1")) << "what runs goes on";
  at(500, order(OrderKind::release));
  run(1000, {});
  EXPECT_EQ(stages(2), kApplied);
  EXPECT_FALSE(reactor.held());
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "image-2"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, UnderAHoldNoPlanIsMadeAnew) {
  at(20, order(OrderKind::hold));
  camera_works = false;
  run(400, robot_and({photo("1")}));
  EXPECT_THAT(trace, Contains("plan.broken"));
  EXPECT_THAT(trace, Contains("call").Times(1));
  camera_works = true;
  at(500, order(OrderKind::release));
  run(1000, {});
  EXPECT_THAT(trace, Contains("call").Times(2));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, OneActivityIsHeldAlone) {
  at(20, order(OrderKind::hold, "p1.2-take-image"));
  at(21, order(OrderKind::hold, "p1.1-take-image"));
  at(22, order(OrderKind::hold, "p1.9-take-image"));
  run(400, robot_and({photo("1"), photo("2")}));
  EXPECT_FALSE(reactor.held());
  EXPECT_THAT(images_begun(), ElementsAre("image-1"));
  EXPECT_EQ(stages(2), kRefused);
  EXPECT_THAT(reason(2), HasSubstr("waits for nothing any more"));
  EXPECT_THAT(reason(3), HasSubstr("plan 1 has no activity 'p1.9-take-image'"));
  at(500, order(OrderKind::release));
  at(501, order(OrderKind::release, "p1.2-take-image"));
  run(1000, {});
  EXPECT_THAT(reason(4), HasSubstr("nothing is held"));
  EXPECT_EQ(stages(5), kApplied);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// R128, E1: a single command runs as a plan of the ground's own.
TEST_F(OrderTest, TheGroundCommandsAComponentItself) {
  at(1, level(AutonomyLevel::e1));
  at(20, image("one"));
  at(30, image("two"));
  run(100, robot_and({}));
  EXPECT_EQ(stages(2), kApplied);
  EXPECT_EQ(reactor.plan_version(), 1U);
  EXPECT_EQ(stages(3), kRefused);
  EXPECT_THAT(reason(3), HasSubstr("camera carries out p1.1-image; wait for its end"));
  EXPECT_THAT(images_begun(), ElementsAre("one"));
  EXPECT_EQ(reactor.phase(), MissionPhase::idle);
  ASSERT_TRUE(reactor.last_executed());
  EXPECT_EQ(reactor.last_executed()->outcome, reactor::ExecutedOutcome::finished);
  camera_works = false;
  at(110, image("three"));
  run(200, {});
  EXPECT_EQ(stages(4), kApplied);
  EXPECT_EQ(reactor.phase(), MissionPhase::idle) << "it fails alone: the ground sees it and decides";
  EXPECT_EQ(reactor.last_executed()->activities.at(0).state, temporal::ActivityState::failed);
}

TEST_F(OrderTest, CommandsThatComeTogetherAreAllGiven) {
  Order drive = order(OrderKind::command, "nav");
  drive.content = state("drive", {"to=w1"});
  at(1, level(AutonomyLevel::e1));
  at(20, image("one"));
  at(20, drive);
  at(20, image("two"));
  run(30, robot_and({}));
  EXPECT_EQ(stages(2), kApplied);
  EXPECT_EQ(stages(3), kApplied);
  EXPECT_THAT(reason(4), HasSubstr("camera carries out p1.1-image; wait for its end"));
  EXPECT_THAT(images_begun(), ElementsAre("one"));
  EXPECT_THAT(commands, Contains(Field(&executive::Command::command_name, "drive")));
}

TEST_F(OrderTest, TheGroundCommandsNothingWhileTheRobotIsMadeSafe) {
  at(5, level(AutonomyLevel::e3));
  at(20, order(OrderKind::safe));
  at(21, order(OrderKind::release));
  at(22, image("one"));
  Order drive = order(OrderKind::command, "nav");
  drive.content = state("drive", {"to=w1"});
  at(23, drive);
  other_events.emplace(seconds(24), [this] {
    pending.observations.push_back({"rover.camera", state("idle")});
  });
  at(24.5, drive);
  hears_cancels = false;
  run(22.5, robot_and({photo("1")}));
  ASSERT_EQ(stages(3), kApplied);
  EXPECT_THAT(reason(4), HasSubstr("camera is not inactive yet"));
  run(100, {});
  EXPECT_THAT(reason(5), HasSubstr("camera is not inactive yet"));
  EXPECT_THAT(reason(6), HasSubstr("commands are being cancelled"));
  EXPECT_THAT(trace, Contains("robot.safe")) << "the watch goes on";
  at(110, image("one"));
  run(120, {});
  EXPECT_EQ(stages(7), kApplied);
}

TEST_F(OrderTest, TheGroundCommandsNothingBesideAPlanOrUnderAHold) {
  const Order image = this->image("one");
  at(20, image);
  run(30, robot_and({photo("1"), photo("2")}));
  EXPECT_THAT(reason(1), HasSubstr("plan 1 runs"));
  at(40, order(OrderKind::safe));
  at(60, image);
  run(70, {});
  EXPECT_THAT(reason(3), HasSubstr("everything is held"));
  at(80, level(AutonomyLevel::e1));
  at(90, order(OrderKind::release));
  Order garbled = image;
  garbled.content = state("image", {"one"});
  at(100, garbled);
  garbled.content = true;
  at(101, garbled);
  garbled.target = "mast";
  at(102, garbled);
  at(110, image);
  run(200, {});
  EXPECT_THAT(reason(6), HasSubstr("'one' is no NAME=VALUE"));
  EXPECT_THAT(reason(7), HasSubstr("names no command"));
  EXPECT_THAT(reason(8), HasSubstr("no component 'mast'; the executive commands: "));
  EXPECT_EQ(stages(9), kApplied);
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "one"));
}

TEST_F(OrderTest, AtE1EachActivityWaitsForItsApproval) {
  at(0.5, order(OrderKind::approve, "p1.1-take-image"));
  at(1, level(AutonomyLevel::e1));
  planning_time = seconds(1);
  at(100, order(OrderKind::approve, "p1.1-take-image"));
  run(400, robot_and({photo("1"), photo("2")}));
  EXPECT_THAT(reason(1), HasSubstr("at autonomy level E4 nothing waits"));
  EXPECT_EQ(stages(3), kApplied);
  EXPECT_THAT(images_begun(), ElementsAre("image-1"));
  at(500, order(OrderKind::approve, "p1.2-take-image"));
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// What the ground has approved before the plan was stopped, it approves again.
TEST_F(OrderTest, AnApprovalServesOneStart) {
  at(1, level(AutonomyLevel::e1));
  planning_time = seconds(1);
  camera_works = false;
  at(100, order(OrderKind::approve, "p1.1-take-image"));
  at(101, order(OrderKind::approve, "p1.2-take-image"));
  run(200, robot_and({photo("1"), photo("2")}));
  ASSERT_EQ(reactor.phase(), MissionPhase::safe);
  camera_works = true;
  at(300, order(OrderKind::relaunch));
  run(400, {});
  EXPECT_THAT(images_begun(), ElementsAre("image-1"));
  at(400, order(OrderKind::approve, "p1.1-take-image"));
  run(500, {});
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "image-1"));
  at(500, order(OrderKind::approve, "p1.2-take-image"));
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, BelowE4ABrokenPlanMakesSafeAndWaits) {
  at(20, level(AutonomyLevel::e3));
  camera_works = false;
  run(400, robot_and({photo("1")}));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_THAT(trace, Contains("call").Times(1));
  EXPECT_EQ(reactor.plan_version(), 1U);
  camera_works = true;
  at(500, level(AutonomyLevel::e4));
  run(1000, {});
  EXPECT_EQ(reactor.plan_version(), 2U) << "with all autonomy it plans anew";
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, BelowE4TheRunningPlanStays) {
  at(5, level(AutonomyLevel::e2));
  other_events.emplace(seconds(20), [this] { pending.goals.push_back(photo("2")); });
  run(40, robot_and({photo("1")}));
  EXPECT_EQ(reactor.phase(), MissionPhase::executing);
  EXPECT_THAT(trace, Not(Contains("cancel")));
  run(1000, {});
  EXPECT_EQ(reactor.plan_version(), 2U) << "when it has ended, the next one is made";
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, E3RetriesAndE2DoesNot) {
  for (const auto& [set, tries] : {std::pair(AutonomyLevel::e3, 2U), std::pair(AutonomyLevel::e2, 1U)}) {
    mission.actions.at("take-image").retries = 1;
    reactor = Reactor(mission);
    commands.clear();
    robot_events.clear();
    now = Time{0};
    camera_works = false;
    at(20, level(set));
    run(400, robot_and({photo("1")}));
    EXPECT_EQ(images_begun().size(), tries) << to_string(set);
    EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  }
}

TEST_F(OrderTest, AValueOfTheGroundIsSeenByThePlan) {
  planner = [this](const reactor::PlanRequest& call) {
    reactor::PlanReply out = image_every_goal(call);
    out.plan.activities.front().pre = temporal::compare("rover.go", temporal::ConditionOp::eq, true);
    return out;
  };
  Order go = order(OrderKind::set_value, "rover.go");
  at(90, go);
  go.content = true;
  reactor::ReactorInputs first = robot_and({photo("1")});
  first.observations.push_back({"rover.go", false});
  at(100, go);
  go.target = "rover.x";
  at(101, go);
  run(99, std::move(first));
  EXPECT_THAT(images_begun(), IsEmpty());
  run(1000, {});
  EXPECT_THAT(reason(1), HasSubstr("has no value"));
  EXPECT_EQ(stages(2), kApplied);
  EXPECT_THAT(reason(3), HasSubstr("'rover.x' is not the ground's; the mission gives it: rover.go"));
  EXPECT_THAT(images_begun(), ElementsAre("image-1"));
}

TEST_F(OrderTest, AnUploadIsTakenWholeOrNotAtAll) {
  mission.actions.at("take-image").contingency = "wipe";
  reactor = Reactor(mission);
  Order garbled = uploaded("contingencies.wipe", kWipe);
  garbled.upload.back() = ' ';
  at(1, garbled);
  at(2, uploaded("contingencies.wipe", "commands: []\n"));
  at(3, uploaded("contingencies.wipe", "{"));
  at(4, uploaded("actions.take-image", kWipe));
  at(5, uploaded("contingencies.wipe", kWipe));
  camera_works = false;
  run(60, robot_and({photo("1")}));
  EXPECT_THAT(reason(1), HasSubstr("checksum"));
  EXPECT_THAT(reason(2), HasSubstr("needs at least one command"));
  EXPECT_THAT(reason(3), HasSubstr("not valid YAML"));
  EXPECT_THAT(reason(4), HasSubstr("the mission lets these: contingencies.wipe"));
  EXPECT_EQ(stages(5), kApplied);
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "wiped")) << "the new contingency";
}

TEST_F(OrderTest, WhatIsDroppedIsLeftOut) {
  at(20, order(OrderKind::drop, "p1.2-take-image"));
  at(21, order(OrderKind::drop, "p1.1-take-image"));
  planner = [this, plans = 0](const reactor::PlanRequest& call) mutable {
    return ++plans == 1 ? image_every_goal(call) : reply(temporal::Verdict::unsolvable);
  };
  run(1000, robot_and({photo("1"), photo("2"), photo("3")}));
  EXPECT_EQ(stages(1), kApplied);
  EXPECT_EQ(stages(2), kRefused);
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "image-3"));
}

// R149: the robot stops, the ground drops what has failed, and launches the rest of the plan again.
TEST_F(OrderTest, AStoppedPlanIsLaunchedAgainWithoutWhatWasDropped) {
  at(5, level(AutonomyLevel::e2));
  at(6, order(OrderKind::relaunch));
  other_events.emplace(seconds(50), [this] { camera_works = false; });
  run(200, robot_and({photo("1"), photo("2"), photo("3")}));
  EXPECT_THAT(reason(2), HasSubstr("no plan was stopped; the robot is executing"));
  ASSERT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "image-2"));
  camera_works = true;
  at(300, order(OrderKind::drop, "p1.1-take-image"));
  at(301, order(OrderKind::drop, "p1.2-take-image"));
  at(310, order(OrderKind::relaunch));
  run(305, {});
  EXPECT_THAT(reason(3), HasSubstr("is done"));
  EXPECT_EQ(stages(4), kAccepted) << "applied by the relaunch";
  run(1000, {});
  EXPECT_EQ(stages(4), kApplied);
  EXPECT_EQ(stages(5), kApplied);
  EXPECT_EQ(order_stages.back().plan_version, 2U);
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "image-2", "image-3"));
  EXPECT_THAT(trace, Contains("plan.relaunched"));
  EXPECT_THAT(trace, Contains("plan.finished"));
}

TEST_F(OrderTest, WhatIsDroppedFromAStoppedPlanGoesWithIt) {
  at(5, level(AutonomyLevel::e2));
  camera_works = false;
  run(200, robot_and({photo("1"), photo("2")}));
  at(300, order(OrderKind::drop, "p1.2-take-image"));
  run(305, {});
  ASSERT_EQ(stages(2), kAccepted);
  at(310, level(AutonomyLevel::e4));
  run(320, {});
  ASSERT_EQ(reactor.plan_version(), 2U);
  EXPECT_EQ(stages(2), (std::vector{OrderStage::received, OrderStage::accepted, OrderStage::refused}));
  EXPECT_THAT(reason(2), HasSubstr("its plan was replaced"));
  at(321, level(AutonomyLevel::e2));
  run(500, {});
  ASSERT_EQ(reactor.phase(), MissionPhase::safe);
  camera_works = true;
  at(510, order(OrderKind::relaunch));
  run(1000, {});
  EXPECT_EQ(stages(2).size(), 3U) << "no later relaunch applies it";
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, AFailedActivityIsTriedAgainByARelaunchUnderItsNextAttempt) {
  at(5, level(AutonomyLevel::e2));
  camera_works = false;
  run(200, robot_and({photo("1")}));
  camera_works = true;
  at(300, order(OrderKind::relaunch));
  run(1000, {});
  ASSERT_THAT(images_begun(), ElementsAre("image-1", "image-1"));
  EXPECT_EQ(commands.back().activity, "p1.1-take-image");
  EXPECT_EQ(commands.back().attempt, 2U);
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, ARelaunchThatComesTooLateIsRefused) {
  planner = [this](const reactor::PlanRequest& call) {
    reactor::PlanReply out = image_every_goal(call);
    out.plan.constraints.push_back({temporal::origin_point, out.plan.activities.back().start_point,
                                    temporal::ConstraintKind::window, seconds(0), seconds(150)});
    return out;
  };
  at(5, level(AutonomyLevel::e2));
  camera_works = false;
  at(300, order(OrderKind::relaunch));
  run(400, robot_and({photo("1"), photo("2")}));
  EXPECT_EQ(stages(2), kRefused);
  EXPECT_THAT(reason(2), HasSubstr("would have had to start before"));
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
}

TEST_F(OrderTest, SafeNowStopsAndHoldsUntilTheGroundSaysOtherwise) {
  at(20, order(OrderKind::safe));
  run(30, robot_and({photo("1")}));
  EXPECT_EQ(stages(1), kApplied);
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_TRUE(reactor.held());
  other_events.emplace(seconds(50), [this] { pending.goals.push_back(photo("2")); });
  run(400, {});
  EXPECT_EQ(reactor.phase(), MissionPhase::safe) << "a goal does not end it";
  EXPECT_EQ(reactor.outcome(), "") << "the mission is not over: the ground goes on with it";
  at(500, order(OrderKind::release));
  run(1000, {});
  EXPECT_EQ(reactor.outcome(), "achieved");
}

TEST_F(OrderTest, SafeIsSaidWhenNothingIsActiveAnyMore) {
  at(20, order(OrderKind::safe));
  other_events.emplace(seconds(19), [this] { robot_is_dead = true; });
  run(22, robot_and({photo("1")}));
  EXPECT_EQ(stages(1), kAccepted);
}

TEST_F(OrderTest, IsGivenOnceAndAnsweredAgain) {
  at(20, order(OrderKind::hold));
  at(30, order(OrderKind::release));
  run(40, robot_and({photo("1")}));
  Order again = order(OrderKind::hold);
  again.key = {"ground", "1"};
  again.sample = {"roci", 0, 7};
  for (const double time_s : {50.0, 60.0})
    other_events.emplace(seconds(time_s), [this, again] { pending.ground_orders.push_back(again); });
  run(1000, {});
  EXPECT_FALSE(reactor.held());
  EXPECT_EQ(stages(1), (std::vector{OrderStage::received, OrderStage::accepted, OrderStage::applied,
                                    OrderStage::applied}))
      << "where it stands; a sample that is heard again is not answered";
}

TEST_F(OrderTest, AnAnswerToADecisionIsAnOrderToo) {
  planner = [this](const reactor::PlanRequest& call) {
    reactor::PlanReply out = image_every_goal(call);
    temporal::DecisionPoint way{"way", "", {}, out.plan.point_count++};
    for (const temporal::PlanActivity& activity : out.plan.activities)
      way.choices.push_back({"only-" + activity.id, {activity.id}});
    out.plan.constraints.clear();
    way.resolver_kind = temporal::ResolverKind::ground;
    out.plan.decisions.push_back(way);
    return out;
  };
  Order answer = order(OrderKind::answer, "p1.way");
  answer.choice = "neither";
  at(20, answer);
  answer.choice = "only-a2";
  at(21, answer);
  run(100, robot_and({photo("1"), photo("2")}));
  EXPECT_EQ(stages(1), (std::vector{OrderStage::received, OrderStage::accepted, OrderStage::refused}));
  EXPECT_THAT(reason(1), HasSubstr("one of: only-a1, only-a2"));
  EXPECT_EQ(stages(2), kApplied);
  EXPECT_THAT(images_begun(), Contains("image-2"));
}

TEST_F(OrderTest, ASnapshotKeepsLevelHoldValuesUploadsAndOrders) {
  mission.actions.at("take-image").contingency = "wipe";
  reactor = Reactor(mission);
  at(1, level(AutonomyLevel::e3));
  Order go = order(OrderKind::set_value, "rover.go");
  go.content = true;
  at(2, go);
  at(3, uploaded("contingencies.wipe", kWipe));
  at(4, order(OrderKind::hold));
  run(10, robot_and({}));
  ASSERT_TRUE(reactor.at_rest());
  const std::string snapshot = reactor.snapshot();
  reactor = Reactor(mission);
  reactor.restore(snapshot);
  EXPECT_TRUE(reactor.held());
  EXPECT_EQ(reactor.order_statuses().size(), 4U);
  EXPECT_EQ(reactor.ground_values().at("rover.go"), temporal::Value(true));
  at(11, order(OrderKind::release));
  camera_works = false;
  run(200, robot_and({photo("1")}));
  EXPECT_THAT(images_begun(), ElementsAre("image-1", "wiped")) << "the contingency that was uploaded";
}

}  // namespace
}  // namespace roci::exec::testing
