#include "sim_svc/world/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using temporal::Time;
using temporal::to_seconds;
using temporal::Value;

namespace {

const State kHere{"idle-at", {"here"}};

TEST(World, FirstTellsEveryTimeline) {
  Flight run(flat_setup());
  EXPECT_EQ(run.state("rover.nav"), kHere);
  EXPECT_EQ(run.state("rover.arm"), (State{"idle-pose", {"stow"}}));
  EXPECT_EQ(run.state("rover.camera"), (State{"idle", {}}));
  EXPECT_EQ(run.state("rover.gripper"), (State{"empty", {}}));
  EXPECT_EQ(run.state("rover.radio"), (State{"idle", {}}));
  EXPECT_EQ(last_value(run.said, "comm.window"), Value{false});
  EXPECT_EQ(last_number(run.said, "rover.x"), 20);
  EXPECT_EQ(last_number(run.said, "rover.battery"), 500000);
  EXPECT_EQ(last_number(run.said, "rover.arm.q4"), 0);
}

TEST(World, SaysNothingTwice) {
  Flight run(flat_setup());
  run.drive(seconds(5), "d", "there", 40, 30);
  run.advance(seconds(2500));
  std::map<std::string, Value> last;
  for (const Output& output : run.said) {
    const auto* seen = std::get_if<Observed>(&output);
    if (!seen) continue;
    const auto [known, is_new] = last.try_emplace(seen->timeline, seen->value);
    EXPECT_TRUE(is_new || known->second != seen->value) << seen->timeline;
    known->second = seen->value;
  }
}

TEST(World, ADriveGoesAndArrives) {
  Flight run(flat_setup());
  run.drive(seconds(5), "d", "there", 40, 20);
  EXPECT_EQ(run.state("rover.nav"), (State{"going-to", {"there"}}));
  EXPECT_EQ(run.stage("d"), Stage::accepted);
  run.advance(seconds(400));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"there"}}));
  EXPECT_EQ(last_number(run.said, "rover.x"), 40);
  EXPECT_NEAR(to_seconds(run.time_of("d")), 205, 20);
}

TEST(World, AStoppedDriveStandsHereOnTheWay) {
  Flight run(flat_setup());
  run.drive(seconds(5), "d", "there", 40, 20);
  run.command(seconds(105), execute("s", "nav", "stop"));
  EXPECT_EQ(run.stage("d"), Stage::cancelled);
  EXPECT_EQ(run.stage("s"), Stage::completed);
  EXPECT_EQ(run.state("rover.nav"), kHere);
  EXPECT_NEAR(last_number(run.said, "rover.x"), 30, 1.5);
  const double x = last_number(run.said, "rover.x");
  run.advance(seconds(500));
  EXPECT_EQ(last_number(run.said, "rover.x"), x);
}

TEST(World, AStopWithoutATaskChangesNothing) {
  Flight run(flat_setup());
  run.drive(seconds(5), "d", "there", 21, 20);
  run.command(seconds(100), execute("s", "nav", "stop"));
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"there"}}));
  EXPECT_EQ(run.stage("s"), Stage::completed);
}

TEST(World, ARefusedPathFailsTheDriveWhereItStands) {
  Flight run(flat_setup());
  run.drive(seconds(1), "first", "there", 21, 20);
  run.command(seconds(60), drive_to("d", "far", 90, 90));
  run.answer(seconds(61), "d", Failure{"no-path", "rocks all around"});
  EXPECT_EQ(run.stage("d"), Stage::failed);
  EXPECT_EQ(run.code("d"), "no-path");
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"there"}}));
}

TEST(World, APathThatComesAfterTheStopIsIgnored) {
  Flight run(flat_setup());
  run.command(seconds(1), drive_to("d", "far", 90, 90));
  run.command(seconds(2), execute("s", "nav", "stop"));
  run.answer(seconds(3), "d", Way{{{90, 90}}});
  run.advance(seconds(100));
  EXPECT_EQ(run.stage("d"), Stage::cancelled);
  EXPECT_EQ(last_number(run.said, "rover.x"), 20);
}

// Paths asked for so far.
std::vector<PathWanted> wishes(const Flight& run) {
  std::vector<PathWanted> out;
  for (const Output& output : run.said) {
    if (const auto* wish = std::get_if<PathWanted>(&output)) out.push_back(*wish);
  }
  return out;
}

FlatSetup setup_with_rock_and_detours(double detours) {
  FlatSetup setup = flat_setup();
  setup.ground.hidden_rocks = {{40, 20, 1}};
  setup.robot.drive.detours = detours;
  setup.robot.drive.look_s = 20;
  return setup;
}

TEST(World, ADriveLooksAtAHiddenRockAndGoesAround) {
  Flight run(setup_with_rock_and_detours(1));
  run.drive(seconds(1), "d", "there", 60, 20);
  run.advance(seconds(500));
  ASSERT_EQ(wishes(run).size(), 2u);
  const PathWanted again = wishes(run).back();
  EXPECT_EQ(again.key.activity, "d");
  EXPECT_NEAR(again.from.x, 40 - 1 - 0.6 - 3, 0.2);
  EXPECT_EQ(again.x, 60);
  EXPECT_EQ(run.stage("d"), Stage::accepted);
  EXPECT_EQ(run.state("rover.nav"), (State{"going-to", {"there"}}));
  run.answer(seconds(500), "d", Way{{{36, 26}, {60, 26}, {60, 20}}});
  run.advance(seconds(1500));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(last_number(run.said, "rover.x"), 60);
}

TEST(World, ALookTakesItsTimeBeforeTheNextPathIsAskedFor) {
  Flight run(setup_with_rock_and_detours(1));
  run.drive(seconds(1), "d", "there", 60, 20);
  std::optional<Time> seen;
  while (wishes(run).size() < 2) {
    const Time change = run.world.next_change().value();
    run.advance(change);
    for (const Output& output : run.said) {
      if (const auto* rock = std::get_if<RockSeen>(&output)) seen = rock->at;
    }
    if (wishes(run).size() == 2) {
      EXPECT_EQ(change - seen.value(), seconds(20));
    }
  }
}

// R146: the rover's own repair, which nobody has to do anything about.
TEST(World, ALookForAWayAroundIsToldAsTheOwnersRepair) {
  Flight run(setup_with_rock_and_detours(1));
  run.drive(seconds(1), "d", "there", 60, 20);
  run.advance(seconds(210));
  const auto status = run.last_ack("d");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->status.stage, Stage::accepted);
  EXPECT_EQ(status->status.code, "repairing");
  EXPECT_THAT(status->status.reason, testing::HasSubstr("rock-1"));
}

TEST(World, AFailedDriveSaysWhyInWords) {
  FlatSetup rocky = flat_setup();
  rocky.ground.hidden_rocks = {{40, 20, 1}};
  Flight blocked(rocky);
  blocked.drive(seconds(1), "d", "there", 60, 20);
  blocked.advance(seconds(500));
  EXPECT_EQ(blocked.last_ack("d")->status.reason,
            "a rock that the map does not show lies on the way (rock-1)");

  Flight lost(flat_setup());
  lost.command(seconds(1), drive_to("d", "far", 90, 90));
  lost.answer(seconds(2), "d", Way{});
  EXPECT_EQ(lost.code("d"), "no-path");
  EXPECT_EQ(lost.last_ack("d")->status.reason, "the path has no way-points");
  EXPECT_EQ(lost.state("rover.nav"), kHere);

  FlatSetup steep = flat_setup();
  steep.ground.site = ramp_site(3);
  Flight stuck(steep);
  stuck.drive(seconds(1), "d", "there", 60, 20);
  stuck.advance(seconds(2000));
  EXPECT_EQ(stuck.code("d"), "stuck");
  EXPECT_EQ(stuck.last_ack("d")->status.reason, "the wheels turn without progress");
}

TEST(World, AfterItsLastDetourADriveFailsAsBlocked) {
  Flight run(setup_with_rock_and_detours(2));
  run.drive(seconds(1), "d", "there", 60, 20);
  for (const double t : {500, 600}) {
    run.advance(seconds(t));
    ASSERT_EQ(run.stage("d"), Stage::accepted);
    run.answer(seconds(t), "d", Way{{{60, 20}}});
  }
  run.advance(seconds(700));
  EXPECT_EQ(wishes(run).size(), 3u);
  EXPECT_EQ(run.code("d"), "blocked");
  EXPECT_EQ(run.state("rover.nav"), kHere);
}

TEST(World, ADriveStoppedWhileItLooksStandsHere) {
  Flight run(setup_with_rock_and_detours(1));
  run.drive(seconds(1), "first", "near", 21, 20);
  run.advance(seconds(60));
  run.drive(seconds(60), "d", "there", 60, 20);
  run.advance(seconds(210));
  ASSERT_EQ(wishes(run).size(), 2u);  // it stands and looks since 206 s
  run.command(seconds(210), execute("s", "nav", "stop"));
  run.advance(seconds(900));
  EXPECT_EQ(run.stage("d"), Stage::cancelled);
  EXPECT_EQ(run.state("rover.nav"), kHere);
  EXPECT_EQ(wishes(run).size(), 2u);
}

TEST(World, AHiddenRockIsReportedOnceAndFailsTheDrive) {
  FlatSetup setup = flat_setup();
  setup.ground.hidden_rocks = {{40, 20, 1}};
  Flight run(setup);
  run.drive(seconds(1), "d1", "there", 60, 20);
  run.advance(seconds(500));
  run.drive(seconds(500), "d2", "there", 60, 20);
  run.advance(seconds(600));
  EXPECT_EQ(run.code("d1"), "blocked");
  EXPECT_EQ(run.code("d2"), "blocked");
  int seen = 0;
  for (const Output& output : run.said) {
    if (const auto* rock = std::get_if<RockSeen>(&output)) {
      ++seen;
      EXPECT_EQ(rock->x, 40);
      EXPECT_EQ(rock->radius, 1);
      EXPECT_EQ(rock->at, run.time_of("d1"));
    }
  }
  EXPECT_EQ(seen, 1);
}

TEST(World, ARockThatFallsOnTheWayBlocksARunningDrive) {
  Flight run(flat_setup());
  run.drive(seconds(1), "d", "there", 60, 20);
  run.disturb(seconds(50), RockFall{{40, 20, 1}});
  run.advance(seconds(500));
  EXPECT_EQ(run.code("d"), "blocked");
}

TEST(World, ARockThatFallsBesideTheWayDoesNotSendTheRoverBack) {
  Flight run(flat_setup());
  run.command(seconds(1), drive_to("d", "there", 60, 40));
  run.answer(seconds(1), "d", Way{{{40, 20}, {60, 20}, {60, 40}}});
  run.disturb(seconds(350), RockFall{{10, 90, 1}});
  run.advance(seconds(900));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_NEAR(to_seconds(run.time_of("d")), 610, 30);
}

TEST(World, ArmMovesToThePoseAndAStopLeavesItBetween) {
  Flight run(flat_setup());
  run.move_arm(seconds(1), "m", "stow", "sampling", {0.5, -1, 1, 0, 0}, 10);
  EXPECT_EQ(run.state("rover.arm"), (State{"going-to", {"sampling"}}));
  run.advance(seconds(30));
  EXPECT_EQ(run.state("rover.arm"), (State{"idle-pose", {"sampling"}}));
  EXPECT_NEAR(last_number(run.said, "rover.arm.q1"), -1, 0.006);
  EXPECT_NEAR(to_seconds(run.time_of("m")), 12, 2);
  run.move_arm(seconds(40), "back", "sampling", "stow", {0, 0, 0, 0, 0}, 10);
  run.command(seconds(45), execute("s", "arm", "stop"));
  EXPECT_EQ(run.state("rover.arm"), (State{"idle-pose", {"arm-here"}}));
  EXPECT_LT(last_number(run.said, "rover.arm.q1"), -0.2);
  EXPECT_GT(last_number(run.said, "rover.arm.q1"), -0.9);
}

TEST(World, ATrajectoryThatStartsElsewhereIsRefused) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("m", "arm", "move", {{"from", "stow"}, {"to", "sampling"}}));
  run.answer(seconds(1), "m", Trajectory{{{0, {1, 0, 0, 0, 0}}, {5, {2, 0, 0, 0, 0}}}});
  EXPECT_EQ(run.code("m"), "bad-trajectory");
  EXPECT_EQ(run.state("rover.arm"), (State{"idle-pose", {"stow"}}));
}

TEST(World, PicksAndDropsASample) {
  Flight run(flat_setup());
  run.drive(seconds(1), "d", "site", 22, 20);
  run.move_arm(seconds(60), "m", "stow", "sampling", {1, 0, 0, 0, 0}, 5);
  run.command(seconds(100), execute("p", "gripper", "pick", {{"sample", "soil"}, {"place", "site"}}));
  EXPECT_EQ(run.state("rover.gripper"), (State{"working", {}}));
  EXPECT_EQ(run.state("rover.sample.soil"), (State{"in-place", {"site"}}));
  run.advance(seconds(200));
  EXPECT_EQ(run.stage("p"), Stage::completed);
  EXPECT_EQ(run.state("rover.gripper"), (State{"holding", {"soil"}}));
  EXPECT_EQ(run.state("rover.sample.soil"), (State{"held", {}}));
  run.move_arm(seconds(200), "m2", "sampling", "deposit", {2, 0, 0, 0, 0}, 5);
  run.command(seconds(220), execute("q", "gripper", "drop", {{"sample", "soil"}, {"place", "site"}}));
  run.advance(seconds(300));
  EXPECT_EQ(run.state("rover.sample.soil"), (State{"dropped", {"site"}}));
  EXPECT_EQ(run.state("rover.gripper"), (State{"empty", {}}));
}

TEST(World, GripperRefusesTheImpossible) {
  Flight run(flat_setup());
  const auto pick = [](const std::string& id, const std::string& place) {
    return execute(id, "gripper", "pick", {{"sample", "soil"}, {"place", place}});
  };
  run.command(seconds(1), pick("p1", "elsewhere"));
  EXPECT_EQ(run.code("p1"), "wrong-place");
  run.command(seconds(2), pick("p2", "here"));
  EXPECT_EQ(run.code("p2"), "wrong-pose");
  run.move_arm(seconds(3), "m", "stow", "deposit", {1, 0, 0, 0, 0}, 5);
  run.command(seconds(20), execute("q", "gripper", "drop", {{"sample", "soil"}, {"place", "here"}}));
  EXPECT_EQ(run.code("q"), "not-held");
}

TEST(World, InterlocksKeepTheRobotWhole) {
  Flight run(flat_setup());
  run.move_arm(seconds(1), "m", "stow", "sampling", {1, 0, 0, 0, 0}, 5);
  run.command(seconds(20), drive_to("d1", "far", 60, 20));
  EXPECT_EQ(run.code("d1"), "arm-not-stowed");
  run.move_arm(seconds(30), "m2", "sampling", "stow", {0, 0, 0, 0, 0}, 5);
  run.command(seconds(60), execute("i", "camera", "image", {{"image", "one"}}));
  run.command(seconds(61), drive_to("d2", "far", 60, 20));
  EXPECT_EQ(run.code("d2"), "camera-busy");
  run.advance(seconds(120));
  run.drive(seconds(120), "d3", "far", 60, 20);
  run.command(seconds(130), execute("i2", "camera", "image", {{"image", "two"}}));
  EXPECT_EQ(run.code("i2"), "driving");
  run.command(seconds(131), execute("m3", "arm", "move", {{"from", "stow"}, {"to", "sampling"}}));
  EXPECT_EQ(run.code("m3"), "driving");
}

// Its memory may be older than what it has told of: it was killed while its disk was full.
TEST(World, ARobotThatIsAskedForAnImageThatItHasNotSaysSo) {
  Flight run(flat_setup());
  run.command(seconds(2), execute("lost", "radio", "send", {{"image", "one"}}));
  EXPECT_EQ(run.code("lost"), "no-image");
  EXPECT_EQ(run.state("rover.image.one"), (State{"missing", {}}));
  run.command(seconds(3), execute("i", "camera", "image", {{"image", "one"}}));
  run.advance(seconds(100));
  EXPECT_EQ(run.state("rover.image.one"), (State{"stored", {}})) << "it is taken anew";
}

TEST(World, AnImageIsStoredThenSentInTheWindow) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("early", "radio", "send", {{"image", "one"}}));
  EXPECT_EQ(run.code("early"), "no-image");
  run.command(seconds(2), execute("i", "camera", "image", {{"image", "one"}}));
  run.advance(seconds(100));
  EXPECT_EQ(run.state("rover.image.one"), (State{"stored", {}}));
  run.command(seconds(100), execute("closed", "radio", "send", {{"image", "one"}}));
  EXPECT_EQ(run.code("closed"), "no-contact");
  run.command(seconds(1000), execute("t", "radio", "send", {{"image", "one"}}));
  EXPECT_EQ(run.state("rover.radio"), (State{"sending", {}}));
  run.advance(seconds(1200));
  EXPECT_EQ(run.stage("t"), Stage::completed);
  EXPECT_EQ(run.state("rover.image.one"), (State{"sent", {}}));
  std::vector<bool> sent;
  for (const Output& output : run.said) {
    if (const auto* image = std::get_if<Image>(&output)) {
      sent.push_back(image->sent);
      EXPECT_EQ(std::string(image->preview.begin(), image->preview.begin() + 13), "P5\n96 64\n255\n");
      EXPECT_EQ(image->preview.size(), 13u + 96 * 64);
      EXPECT_EQ(image->kind, "image");
      EXPECT_GT(image->bytes, 1000000u);
      EXPECT_EQ(image->source, "i");
    }
  }
  EXPECT_EQ(sent, (std::vector<bool>{false, true}));
  const Image kept = run.world.memory().robots.at("rover").images.at("one");
  EXPECT_TRUE(kept.sent);
  EXPECT_TRUE(kept.preview.empty()) << "it is on the other side, and a month has a hundred";
}

TEST(World, AWindowThatClosesCutsTheSendOff) {
  Flight run(flat_setup());
  run.command(seconds(2), execute("i", "camera", "image", {{"image", "one"}}));
  run.command(seconds(1950), execute("t", "radio", "send", {{"image", "one"}}));
  run.advance(seconds(2100));
  EXPECT_EQ(run.code("t"), "contact-lost");
  EXPECT_EQ(run.time_of("t"), seconds(2000));
  EXPECT_EQ(run.state("rover.image.one"), (State{"stored", {}}));
}

TEST(World, WindowsOpenAndCloseOnTime) {
  Flight run(flat_setup());
  run.advance(seconds(5000));
  std::vector<std::pair<Time, Value>> seen;
  for (const Output& output : run.said) {
    const auto* observed = std::get_if<Observed>(&output);
    if (observed && observed->timeline == "comm.window") seen.emplace_back(observed->at, observed->value);
  }
  EXPECT_EQ(seen, (std::vector<std::pair<Time, Value>>{
                      {Time{}, false}, {seconds(1000), true}, {seconds(2000), false}}));
}

TEST(World, ABrokenComponentFailsItsTaskAndTheNextOnesUntilItIsWellAgain) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("i1", "camera", "image", {{"image", "one"}}));
  run.disturb(seconds(10), ComponentFault{"rover", "camera", seconds(100)});
  EXPECT_EQ(run.code("i1"), "fault");
  EXPECT_EQ(run.state("rover.camera"), (State{"idle", {}}));
  run.command(seconds(50), execute("i2", "camera", "image", {{"image", "one"}}));
  EXPECT_EQ(run.code("i2"), "fault");
  run.command(seconds(100), execute("i3", "camera", "image", {{"image", "one"}}));
  EXPECT_EQ(run.stage("i3"), Stage::accepted);
}

TEST(World, NumbersComeOftenWhileItMovesAndSeldomWhileItRests) {
  Flight run(flat_setup());
  const auto count = [&] {
    int n = 0;
    for (const Output& output : run.said) {
      const auto* seen = std::get_if<Observed>(&output);
      n += seen && seen->timeline == "rover.battery";
    }
    return n;
  };
  run.advance(seconds(600));
  EXPECT_EQ(count(), 11);
  run.drive(seconds(600), "d", "there", 110, 20);
  run.advance(seconds(1200));
  EXPECT_NEAR(count(), 71, 1);
}

// As a robot that outlives the process that speaks for it.
TEST(World, GoesOnFromTheMemoryOfAnotherOne) {
  Flight before(flat_setup());
  before.drive(seconds(5), "d", "there", 40, 20);
  before.advance(seconds(400));
  before.command(seconds(401), execute("i", "camera", "image", {{"image", "rock"}}));
  before.advance(seconds(500));
  before.move_arm(seconds(501), "m", "stow", "sampling", {0, 1, 0, 0, 0.5}, 20);
  before.advance(seconds(600));
  before.command(seconds(601), execute("p", "gripper", "pick", {{"sample", "soil"}, {"place", "there"}}));
  before.advance(seconds(700));
  ASSERT_EQ(before.stage("p"), Stage::completed);
  before.command(seconds(701), execute("p2", "camera", "image", {{"image", "cut off"}}));
  before.advance(seconds(702));

  World after(flat_setup().build(), 1);
  after.restore(before.world.memory());
  const Outputs said = after.advance(seconds(720));
  EXPECT_EQ(last_value(said, "rover.image.rock"), Value(State{"stored", {}}));
  EXPECT_EQ(last_value(said, "rover.image.cut off"), std::nullopt) << "it was being taken";
  EXPECT_EQ(last_value(said, "rover.camera"), Value(State{"idle", {}}));
  EXPECT_EQ(last_value(said, "rover.nav"), Value(State{"idle-at", {"there"}}));
  EXPECT_EQ(last_value(said, "rover.arm"), Value(State{"idle-pose", {"sampling"}}));
  EXPECT_EQ(last_value(said, "rover.gripper"), Value(State{"holding", {"soil"}}));
  EXPECT_EQ(last_value(said, "rover.sample.soil"), Value(State{"held", {}}));
  EXPECT_EQ(last_number(said, "rover.x"), 40);
  EXPECT_NEAR(last_number(said, "rover.arm.q1"), 1, 0.02);
  const double then = before.world.memory().robots.at("rover").energy_j.value();
  EXPECT_NEAR(after.memory().robots.at("rover").energy_j.value(), then - 18 * 14, 2)
      << "the idle power of 18 s";
}

}  // namespace
}  // namespace roci::sim::world
