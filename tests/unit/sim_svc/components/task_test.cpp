#include "sim_svc/components/task.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;

namespace {

TaskSettings drill() {
  TaskSettings out;
  out.start = {"up", {}};
  out.numbers = {{"depth", 1, 1e-3}, {"bits", 4, 1}};
  TaskCommand bore{"bore", {"hole"}, 100, 0, 50};
  bore.during = StateTemplate{"boring", {"{hole}"}};
  bore.then = StateTemplate{"in", {"{hole}", "deep"}};
  bore.stopped = StateTemplate{"jammed", {}};
  bore.needs = {{"clamp", "closed"}};
  bore.changes = {{"depth", {20, std::nullopt}}, {"bits", {0, 3}}};
  bore.leaves = {{"hole.{hole}", {"bored", {"{hole}"}}}};
  out.commands = {bore, {"wait", {}, 10, 0.5, 0}};
  return out;
}

TaskSettings clamp() {
  TaskSettings out;
  out.start = {"open", {}};
  TaskCommand close{"close", {}, 0};
  close.then = StateTemplate{"closed", {}};
  TaskCommand charge{"charge", {}, 50, 0, -30};
  out.commands = {close, charge};
  return out;
}

world::WorldSetup station() {
  world::RobotSetup robot;
  robot.name = "station";
  robot.power = world::PowerSetup{{100000, 10, 0, 0, 1}, 50000};
  robot.components = {part<TaskComponent>("drill", "task", drill()),
                      part<TaskComponent>("clamp", "task", clamp())};
  return {{}, {}, {robot}};
}

TEST(TaskComponent, GoesFromStateToStateAndChangesItsNumbers) {
  Flight run(station());
  EXPECT_EQ(run.state("station.drill"), (State{"up", {}}));
  EXPECT_EQ(last_number(run.said, "station.drill.depth"), 1);
  run.command(seconds(1), execute("c", "clamp", "close"));
  EXPECT_EQ(run.stage("c"), Stage::completed);
  EXPECT_EQ(run.time_of("c"), seconds(1));
  run.command(seconds(2), execute("b", "drill", "bore", {{"hole", "h1"}}));
  EXPECT_EQ(run.state("station.drill"), (State{"boring", {"h1"}}));
  run.advance(seconds(52));
  EXPECT_NEAR(last_number(run.said, "station.drill.depth"), 11, 2.1);  // told every 10 s
  EXPECT_EQ(last_number(run.said, "station.drill.bits"), 4);
  run.advance(seconds(102));
  EXPECT_EQ(run.state("station.drill"), (State{"in", {"h1", "deep"}}));
  EXPECT_EQ(last_number(run.said, "station.drill.depth"), 21);
  EXPECT_EQ(last_number(run.said, "station.drill.bits"), 3);
  const auto results = run.last_ack("b")->status.results;
  EXPECT_EQ(results.duration, seconds(100));
  EXPECT_NEAR(results.energy_j.value(), 5000, 1e-6);
  EXPECT_EQ(results.values.at("depth"), temporal::Value{21.0});
  EXPECT_NEAR(last_number(run.said, "station.battery"), 50000 - 102 * 10 - 5000, 1);
}

// The clamp is closed at 1 s, and the drill bores from 2 s on, for 100 s at its usual pace.
Flight boring() {
  Flight run(station());
  run.command(seconds(1), execute("c", "clamp", "close"));
  run.command(seconds(2), execute("b", "drill", "bore", {{"hole", "h1"}}));
  return run;
}

TEST(TaskComponent, SlowedByAFaultItTakesLongerAndKeepsWhatItHasDone) {
  Flight run = boring();
  run.disturb(seconds(22), world::ComponentFault{"station", "drill", seconds(62), 0.5});
  run.advance(seconds(62));
  EXPECT_EQ(run.state("station.drill"), (State{"boring", {"h1"}}));
  run.advance(seconds(200));
  EXPECT_EQ(run.time_of("b"), seconds(122)) << "40 s at half the pace cost 20 s";
  EXPECT_EQ(last_number(run.said, "station.drill.depth"), 21);
  EXPECT_NEAR(run.last_ack("b")->status.results.energy_j.value(), 120 * 50, 1e-6)
      << "it draws its power all the time";
}

TEST(TaskComponent, StuckItGoesOnWhenTheFaultIsOver) {
  Flight run = boring();
  run.disturb(seconds(52), world::ComponentFault{"station", "drill", seconds(352), 0});
  run.advance(seconds(340));
  EXPECT_NEAR(last_number(run.said, "station.drill.depth"), 11, 1e-9);
  EXPECT_EQ(run.state("station.drill"), (State{"boring", {"h1"}}));
  run.advance(seconds(500));
  EXPECT_EQ(run.time_of("b"), seconds(402));
  run.command(seconds(501), execute("w", "drill", "wait"));
  run.advance(seconds(600));
  EXPECT_LE(run.time_of("w"), seconds(501 + 30)) << "a later task has its usual pace";
}

TEST(TaskComponent, SlowedSoMuchThatItEndsWhileTheFaultLasts) {
  Flight run = boring();
  run.disturb(seconds(3), world::ComponentFault{"station", "drill", seconds(9000), 0.25});
  run.advance(seconds(9000));
  EXPECT_EQ(run.time_of("b"), seconds(2 + 1 + 4 * 99));
}

// The clamp gives 30 W for 50 s, and the station draws 10 W: the battery rises by 1,000 J.
Flight charging(double gains_j, double power_w = -30, double energy_j = 50000,
                std::optional<double> within_s = std::nullopt) {
  TaskSettings settings = clamp();
  settings.commands[1].gains_within_s = within_s;
  settings.commands[1].power_w = power_w;
  settings.commands[1].gains_j = gains_j;
  settings.commands[1].then = StateTemplate{"ready", {}};
  settings.commands[1].stopped = StateTemplate{"dark", {}};
  world::WorldSetup setup = station();
  setup.robots[0].power->start_j = energy_j;
  setup.robots[0].components[1] = part<TaskComponent>("clamp", "task", settings);
  Flight run(setup);
  run.command(seconds(1), execute("c", "clamp", "charge"));
  run.advance(seconds(100));
  return run;
}

TEST(TaskComponent, FailsIfTheBatteryHasNotRisenByWhatWasToComeIn) {
  const Flight enough = charging(999);
  EXPECT_EQ(enough.stage("c"), Stage::completed);
  EXPECT_EQ(enough.state("station.clamp"), (State{"ready", {}}));

  const Flight little = charging(1001);
  EXPECT_EQ(little.stage("c"), Stage::failed);
  EXPECT_EQ(little.code("c"), "no-gain");
  EXPECT_EQ(little.time_of("c"), seconds(51));
  EXPECT_EQ(little.state("station.clamp"), (State{"dark", {}}));
  EXPECT_EQ(little.last_ack("c")->status.reason,
            "the battery has risen by 1000 J during charge, at least 1001 J were to come in; look at what "
            "charges it");

  const Flight none = charging(1000, 0);
  EXPECT_EQ(none.code("c"), "no-gain");
  EXPECT_EQ(none.last_ack("c")->status.reason,
            "the battery has not risen, but fallen by 500 J during charge, at least 1000 J were to come in; "
            "look at what charges it");
}

TEST(TaskComponent, MayBeLookedAtBeforeItsEndAndThenFailsAtOnce) {
  const Flight enough = charging(199, -30, 50000, 10);
  EXPECT_EQ(enough.stage("c"), Stage::completed);
  EXPECT_EQ(enough.time_of("c"), seconds(51)) << "it goes on to its end";

  const Flight little = charging(201, -30, 50000, 10);
  EXPECT_EQ(little.code("c"), "no-gain");
  EXPECT_EQ(little.time_of("c"), seconds(11));
  EXPECT_EQ(little.state("station.clamp"), (State{"dark", {}}));
  EXPECT_THAT(
      little.last_ack("c")->status.reason,
      testing::StartsWith("the battery has risen by 200 J in the first 10 s of charge, at least 201 J"));
}

TEST(TaskComponent, FailedItMayStandOtherwiseThanBrokenOff) {
  TaskSettings settings = clamp();
  settings.commands[1].power_w = 0;
  settings.commands[1].gains_j = 1;
  settings.commands[1].stopped = StateTemplate{"ready", {}};
  settings.commands[1].failed = StateTemplate{"dark", {}};
  world::WorldSetup setup = station();
  setup.robots[0].components[1] = part<TaskComponent>("clamp", "task", settings);
  Flight run(setup);
  run.command(seconds(1), execute("a", "clamp", "charge"));
  run.command(seconds(2), execute("s", "clamp", "stop"));
  EXPECT_EQ(run.state("station.clamp"), (State{"ready", {}}));
  run.command(seconds(3), execute("b", "clamp", "charge"));
  run.advance(seconds(100));
  EXPECT_EQ(run.code("b"), "no-gain");
  EXPECT_EQ(run.state("station.clamp"), (State{"dark", {}}));
}

TEST(TaskComponent, AFullBatteryNeedNotRise) {
  EXPECT_EQ(charging(1000, -30, 100000).stage("c"), Stage::completed);
  EXPECT_EQ(charging(0, 0).stage("c"), Stage::completed) << "nothing was to come in";
}

TEST(TaskComponent, LeavesThingsInAStateOnceItIsDone) {
  Flight run = boring();
  run.advance(seconds(101));
  EXPECT_FALSE(last_value(run.said, "station.hole.h1").has_value());
  run.advance(seconds(102));
  EXPECT_EQ(last_value(run.said, "station.hole.h1"), temporal::state("bored", {"h1"}));
}

TEST(TaskComponent, ThingsOfTheSettingsHaveAStateFromTheBeginning) {
  TaskSettings settings = drill();
  settings.things = {{"hole.h1", {"untouched", {}}}, {"hole.h2", {"bored", {"by", "others"}}}};
  world::WorldSetup setup = station();
  setup.robots[0].components[0] = part<TaskComponent>("drill", "task", settings);
  Flight run(setup);
  EXPECT_EQ(run.state("station.hole.h1"), (State{"untouched", {}}));
  EXPECT_EQ(run.state("station.hole.h2"), (State{"bored", {"by", "others"}}));
  run.command(seconds(1), execute("c", "clamp", "close"));
  run.command(seconds(2), execute("b", "drill", "bore", {{"hole", "h1"}}));
  run.advance(seconds(102));
  EXPECT_EQ(run.state("station.hole.h1"), (State{"bored", {"h1"}}));
  const auto forms = TaskComponent(settings, world::RandomStream(1, "task")).thing_forms();
  ASSERT_EQ(forms.size(), 1u);
  EXPECT_EQ(forms[0].states, (std::vector<world::StateForm>{{"bored", 1}, {"bored", 2}, {"untouched", 0}}));
  world::World again(setup, 1);
  again.restore(run.world.memory());
  EXPECT_EQ(last_value(again.advance(run.time_of("b")), "station.hole.h1"), temporal::state("bored", {"h1"}))
      << "a process that is started again knows what was left";
}

TEST(TaskComponent, AHollowSuccessIsToldAndChangesNothing) {
  Flight run = boring();
  run.disturb(seconds(3), world::HollowSuccess{"station", "drill", "bore"});
  run.advance(seconds(102));
  EXPECT_EQ(run.stage("b"), Stage::completed);
  EXPECT_EQ(run.state("station.drill"), (State{"up", {}}));
  EXPECT_EQ(last_number(run.said, "station.drill.depth"), 1);
  EXPECT_EQ(last_number(run.said, "station.drill.bits"), 4);
  EXPECT_FALSE(last_value(run.said, "station.hole.h1").has_value());
  EXPECT_NEAR(run.last_ack("b")->status.results.energy_j.value(), 5000, 1e-6) << "what it used is gone";
  run.command(seconds(110), execute("b2", "drill", "bore", {{"hole", "h1"}}));
  run.advance(seconds(300));
  EXPECT_EQ(run.state("station.drill"), (State{"in", {"h1", "deep"}})) << "the next one is true again";
}

TEST(TaskComponent, NeedsOtherPartsInTheirStates) {
  Flight run(station());
  run.command(seconds(1), execute("b", "drill", "bore", {{"hole", "h1"}}));
  EXPECT_EQ(run.stage("b"), Stage::failed);
  EXPECT_EQ(run.code("b"), "not-ready");
  EXPECT_EQ(run.last_ack("b")->status.reason, "clamp is open, not closed");
  EXPECT_EQ(run.state("station.drill"), (State{"up", {}}));
}

TEST(TaskComponent, AStopLeavesItWhereItIs) {
  Flight run(station());
  run.command(seconds(1), execute("c", "clamp", "close"));
  run.command(seconds(2), execute("b", "drill", "bore", {{"hole", "h1"}}));
  run.command(seconds(27), execute("s", "drill", "stop"));
  EXPECT_EQ(run.stage("b"), Stage::cancelled);
  EXPECT_EQ(run.state("station.drill"), (State{"jammed", {}}));
  EXPECT_EQ(last_number(run.said, "station.drill.depth"), 6);
  EXPECT_EQ(last_number(run.said, "station.drill.bits"), 4);
}

TEST(TaskComponent, NegativePowerChargesTheBattery) {
  Flight run(station());
  run.command(seconds(1), execute("c", "clamp", "charge"));
  run.advance(seconds(101));
  EXPECT_NEAR(last_number(run.said, "station.battery"), 50000 - 51 * 10 + 50 * 30, 1);
  EXPECT_EQ(run.state("station.clamp"), (State{"open", {}}));
}

TEST(TaskComponent, NoiseMakesItLongerOrShorter) {
  const auto duration = [](std::uint64_t seed) {
    Flight run(station(), seed);
    run.command(seconds(1), execute("w", "drill", "wait"));
    run.advance(seconds(60));
    return run.time_of("w");
  };
  EXPECT_EQ(duration(1), duration(1));
  EXPECT_NE(duration(1), duration(2));
}

}  // namespace
}  // namespace roci::sim::components
