// Robots of all makes: without some of what a rover has, several in one world, of parts that a test brings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using temporal::Time;

namespace {

using testing::HasSubstr;

WorldSetup rover_without(const std::string& component) {
  WorldSetup setup = flat_setup().build();
  std::erase_if(setup.robots[0].components, [&](const ComponentSetup& c) { return c.name == component; });
  return setup;
}

// Two rovers, the second one 50 m north of the first.
WorldSetup two_rovers() {
  FlatSetup first;
  FlatSetup second;
  second.robot.name = "scout";
  second.robot.start.y = 70;
  WorldSetup setup = first.build();
  setup.robots.push_back(second.robot.build());
  return setup;
}

TEST(Robots, WithoutAnArmItDrivesAndGripsWithoutAskingForAPose) {
  Flight run(rover_without("arm"));
  EXPECT_FALSE(last_value(run.said, "rover.arm"));
  EXPECT_FALSE(last_value(run.said, "rover.arm.q0"));
  run.drive(seconds(1), "d", "there", 40, 20);
  run.advance(seconds(400));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  run.command(seconds(400), execute("p", "gripper", "pick", {{"sample", "soil"}, {"place", "there"}}));
  run.advance(seconds(500));
  EXPECT_EQ(run.state("rover.gripper"), (State{"holding", {"soil"}}));
  run.command(seconds(500), execute("m", "arm", "move", {{"from", "a"}, {"to", "b"}}));
  EXPECT_EQ(run.code("m"), "unknown-component");
}

TEST(Robots, WithoutACameraItDrives) {
  Flight run(rover_without("camera"));
  EXPECT_FALSE(last_value(run.said, "rover.camera"));
  run.drive(seconds(1), "d", "there", 40, 20);
  run.advance(seconds(400));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  run.command(seconds(1000), execute("t", "radio", "send", {{"image", "one"}}));
  EXPECT_EQ(run.code("t"), "no-image");
}

TEST(Robots, WithoutWheelsItTakesImagesAndMovesItsArm) {
  Flight run(rover_without("nav"));
  run.command(seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  run.move_arm(seconds(1), "m", "stow", "sampling", {1, 0, 0, 0, 0}, 5);
  run.advance(seconds(100));
  EXPECT_EQ(run.stage("i"), Stage::completed);
  EXPECT_EQ(run.state("rover.arm"), (State{"idle-pose", {"sampling"}}));
  run.command(seconds(100), execute("p", "gripper", "pick", {{"sample", "soil"}, {"place", "anywhere"}}));
  EXPECT_EQ(run.stage("p"), Stage::accepted);
}

TEST(Robots, WithoutABatteryItNeverRunsDry) {
  FlatSetup flat;
  flat.robot.battery_j = 10;  // a second of idle
  WorldSetup setup = flat.build();
  setup.robots[0].power.reset();
  Flight run(setup);
  EXPECT_FALSE(last_value(run.said, "rover.battery"));
  run.drive(seconds(1), "d", "there", 40, 20);
  run.disturb(seconds(2), EnergyLoss{"rover", 1e9});
  run.advance(seconds(400));
  EXPECT_EQ(run.stage("d"), Stage::completed);
}

TEST(Robots, WithoutAPoseItHasNoPlaceOnTheMap) {
  WorldSetup setup = rover_without("nav");
  setup.robots[0].pose.reset();
  Flight run(setup);
  EXPECT_FALSE(last_value(run.said, "rover.x"));
  EXPECT_TRUE(last_value(run.said, "rover.battery"));
}

TEST(Robots, TwoInOneWorldActForThemselves) {
  Flight run(two_rovers());
  EXPECT_EQ(run.state("scout.nav"), (State{"idle-at", {"here"}}));
  EXPECT_EQ(last_number(run.said, "scout.y"), 70);
  EXPECT_EQ(last_number(run.said, "scout.arm.q0"), 0);
  run.drive(seconds(1), "d", "there", 40, 70, "scout");
  run.advance(seconds(400));
  EXPECT_EQ(run.state("scout.nav"), (State{"idle-at", {"there"}}));
  EXPECT_EQ(last_number(run.said, "scout.x"), 40);
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"here"}}));
  EXPECT_EQ(last_number(run.said, "rover.x"), 20);
  EXPECT_LT(last_number(run.said, "scout.battery"), last_number(run.said, "rover.battery"));
  const auto begun = run.world.take_begun();
  ASSERT_EQ(begun.size(), 1u);
  EXPECT_EQ(begun[0].robot, "scout");
  EXPECT_EQ(begun[0].component, "nav");
}

TEST(Robots, AmongSeveralACommandNamesItsRobot) {
  Flight run(two_rovers());
  run.command(seconds(1), execute("a", "camera", "image", {{"image", "one"}}));
  EXPECT_EQ(run.code("a"), "unknown-robot");
  EXPECT_THAT(run.last_ack("a")->status.reason, HasSubstr("rover, scout"));
  auto request = execute("b", "camera", "image", {{"image", "one"}});
  request.robot = "third";
  run.command(seconds(2), request);
  EXPECT_EQ(run.code("b"), "unknown-robot");
  EXPECT_THAT(run.last_ack("b")->status.reason, HasSubstr("'third'"));
}

TEST(Robots, AFaultAndALossConcernTheirRobotAlone) {
  Flight run(two_rovers());
  for (const std::string robot : {"rover", "scout"}) {
    auto request = execute("i-" + robot, "camera", "image", {{"image", "one"}});
    request.robot = robot;
    run.command(seconds(1), request);
  }
  run.disturb(seconds(2), ComponentFault{"scout", "camera", seconds(9)});
  EXPECT_EQ(run.code("i-scout"), "fault");
  EXPECT_EQ(run.stage("i-rover"), Stage::accepted);
  run.disturb(seconds(3), EnergyLoss{"rover", 1e9});
  EXPECT_EQ(run.code("i-rover"), "battery-flat");
  run.advance(seconds(70));
  EXPECT_GT(last_number(run.said, "scout.battery"), 400000);
}

// A second robot changes nothing of what the first one does, to the last digit.
TEST(Robots, TheFirstRobotsNoiseIsItsOwn) {
  const auto arrival = [](WorldSetup setup, const std::string& robot, double y) {
    Flight run(std::move(setup), 5);
    run.drive(seconds(1), "d", "there", 60, y, robot);
    run.advance(seconds(900));
    return run.time_of("d");
  };
  const Time alone = arrival(flat_setup().build(), "rover", 20);
  EXPECT_EQ(arrival(two_rovers(), "rover", 20), alone);
  EXPECT_NE(arrival(two_rovers(), "scout", 70), alone);
}

TEST(Robots, ASecondPartOfOneTypeHasNoiseOfItsOwn) {
  FlatSetup flat;
  WorldSetup setup = flat.build();
  setup.robots[0].components.push_back(part<components::Camera>("mast", "camera", flat.robot.camera));
  Flight run(setup);
  run.command(seconds(1), execute("a", "camera", "image", {{"image", "one"}}));
  run.command(seconds(1), execute("b", "mast", "image", {{"image", "two"}}));
  run.advance(seconds(100));
  EXPECT_EQ(run.stage("a"), Stage::completed);
  EXPECT_EQ(run.stage("b"), Stage::completed);
  EXPECT_NE(run.time_of("a"), run.time_of("b"));
}

// One truth for all: a sample that one robot carried off is no longer where it lay, and lies where it was
// put.
TEST(Robots, ASampleIsInOnePlace) {
  FlatSetup first;
  first.robot.gripper.pick_pose = first.robot.gripper.drop_pose = "stow";
  FlatSetup second = first;
  second.robot.name = "scout";
  WorldSetup setup = first.build();
  setup.robots.push_back(second.robot.build());
  Flight run(setup);
  const auto grip = [&](Time now, const std::string& id, const std::string& robot,
                        const std::string& command) {
    auto request = execute(id, "gripper", command, {{"sample", "soil"}, {"place", "here"}});
    request.robot = robot;
    run.command(now, request);
    run.advance(now + seconds(100));
  };
  grip(seconds(1), "p1", "rover", "pick");
  grip(seconds(200), "p2", "scout", "pick");
  EXPECT_EQ(run.code("p2"), "no-sample");
  EXPECT_FALSE(last_value(run.said, "scout.sample.soil"));
  grip(seconds(400), "q1", "rover", "drop");
  grip(seconds(600), "p3", "scout", "pick");
  EXPECT_EQ(run.stage("p3"), Stage::completed);
  EXPECT_EQ(run.state("scout.sample.soil"), (State{"held", {}}));
  EXPECT_EQ(run.state("rover.sample.soil"), (State{"dropped", {"here"}}));
}

// Two robots that meet the same rock speak of it by the same name.
TEST(Robots, ARockHasOneNameForAll) {
  WorldSetup setup = two_rovers();
  setup.ground.hidden_rocks = {{40, 70, 1}, {40, 20, 1}};
  Flight run(setup);
  run.drive(seconds(1), "a", "there", 60, 20, "rover");
  run.advance(seconds(400));
  run.drive(seconds(400), "b", "there", 60, 70, "scout");
  run.advance(seconds(800));
  run.drive(seconds(800), "c", "there", 40, 10, "scout");
  run.advance(seconds(1800));
  std::vector<std::string> seen;
  for (const Output& output : run.said) {
    if (const auto* rock = std::get_if<RockSeen>(&output)) seen.push_back(rock->robot + " " + rock->id);
  }
  EXPECT_THAT(seen, testing::ElementsAre("rover rock-1", "scout rock-2", "scout rock-1"));
}

TEST(Robots, NamesAreUnique) {
  FlatSetup flat;
  WorldSetup setup = flat.build();
  setup.robots.push_back(flat.robot.build());
  EXPECT_THROW(World(setup, 1), std::invalid_argument);
  setup = flat.build();
  setup.robots[0].components.push_back(part<components::Radio>("nav", "radio", flat.robot.radio));
  EXPECT_THROW(World(setup, 1), std::invalid_argument);
}

// A part of somebody else: a lamp that lights for as long as it is told, and forbids driving meanwhile.
class Lamp final : public Component, public BodyInterlock {
 public:
  std::vector<CommandForm> commands() const override { return {{"light", {"s"}}}; }
  State state() const override { return until_ ? State{"lit", {}} : State{"dark", {}}; }
  bool busy() const override { return until_.has_value(); }
  Ending begin(const Task& task, Time now, Surroundings&) override {
    until_ = now + seconds(std::stod(task.arguments.at("s")));
    return std::nullopt;
  }
  std::optional<Time> next_change() const override { return until_; }
  Ending finish(Surroundings&) override {
    until_.reset();
    return std::nullopt;
  }
  void halt(Time, Surroundings&) override { until_.reset(); }
  double energy_j(Time from, Time to) const override {
    return until_ ? 100 * temporal::to_seconds(to - from) : 0;
  }
  double peak_power_w() const override { return until_ ? 100 : 0; }
  std::map<std::string, temporal::Value> results() const override { return {{"lit", true}}; }
  Ending forbids_driving() const override {
    if (!until_) return std::nullopt;
    return Failure{"blinded", "the lamp is lit"};
  }

 private:
  std::optional<Time> until_;
};

TEST(Robots, APartOfATestFitsIn) {
  FlatSetup flat;
  WorldSetup setup = flat.build();
  setup.robots[0].components.push_back(
      {"lamp", "lamp", [](RandomStream) { return std::make_unique<Lamp>(); }});
  Flight run(setup);
  EXPECT_EQ(run.state("rover.lamp"), (State{"dark", {}}));
  run.command(seconds(1), execute("l", "lamp", "light", {{"s", "30"}}));
  EXPECT_EQ(run.state("rover.lamp"), (State{"lit", {}}));
  run.command(seconds(2), drive_to("d", "there", 40, 20));
  EXPECT_EQ(run.code("d"), "blinded");
  run.advance(seconds(100));
  const auto ack = run.last_ack("l").value();
  EXPECT_EQ(ack.status.stage, Stage::completed);
  EXPECT_EQ(ack.status.results.duration, seconds(30));
  EXPECT_NEAR(ack.status.results.energy_j.value(), 3000, 1e-6);
  EXPECT_EQ(ack.status.results.values.at("lit"), temporal::Value{true});
}

TEST(Robots, ARepairHasToFitIntoItsStep) {
  FlatSetup flat;
  flat.ground.hidden_rocks = {{40, 20, 1}};
  flat.robot.drive.detours = 3;
  for (const double latest_s : {165.0, 260.0}) {
    Flight run(flat);
    auto request = drive_to("d", "there", 60, 20);
    request.latest_end = seconds(latest_s);
    run.command(seconds(1), request);
    run.answer(seconds(1), "d", Way{{{60, 20}}});
    run.advance(seconds(240));
    EXPECT_EQ(run.code("d"), latest_s > 230 ? "repairing" : "blocked") << latest_s;
  }
}

}  // namespace
}  // namespace roci::sim::world
