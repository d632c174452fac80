#include "sim_svc/world/battery.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using temporal::Time;

namespace {

TEST(Battery, HoldsAtMostItsCapacityAndNeverLessThanNothing) {
  Battery battery(50, 100);
  battery.add(80);
  EXPECT_EQ(battery.energy_j(), 100);
  battery.add(-300);
  EXPECT_EQ(battery.energy_j(), 0);
}

TEST(Battery, StaysFlatUntilAHundredthIsThereAgain) {
  Battery battery(1, 100);
  EXPECT_FALSE(battery.flat());
  battery.add(-1);
  EXPECT_TRUE(battery.flat());
  battery.add(0.9);
  EXPECT_TRUE(battery.flat());
  battery.add(0.2);
  EXPECT_FALSE(battery.flat());
}

TEST(Battery, AGaugeMayTellLessThanThereIsBelowSomeCharge) {
  const Gauge gauge{1000, 2};
  EXPECT_EQ(told_j(gauge, 5000), 5000);
  EXPECT_EQ(told_j(gauge, 1000), 1000);
  EXPECT_EQ(told_j(gauge, 900), 800);
  EXPECT_EQ(told_j(gauge, 300), 0);
  EXPECT_EQ(told_j({1000, 0.5}, 900), 950) << "or more";
  EXPECT_EQ(told_j({}, 900), 900);
}

TEST(Battery, SunIsHighestAtNoonAndGoneAtNight) {
  PowerParameters power;
  power.solar_peak_w = 40;
  EXPECT_DOUBLE_EQ(solar_power_w(power, seconds(power.solar_noon_s)), 40);
  EXPECT_EQ(solar_power_w(power, seconds(power.solar_noon_s + power.day_s / 2)), 0);
}

TEST(Battery, InOrbitThePanelWorksInSunlightAlone) {
  PowerParameters power;
  power.orbit = Orbit{600, 200, 300, 500, "sun.window"};
  const auto joules = [&power](double from, double to) {
    return solar_energy_j(power, seconds(from), seconds(to));
  };
  EXPECT_DOUBLE_EQ(joules(0, 300), 300 * 500) << "before the first eclipse";
  EXPECT_DOUBLE_EQ(joules(300, 500), 0);
  EXPECT_DOUBLE_EQ(joules(400, 600), 100 * 500) << "an eclipse ends";
  EXPECT_DOUBLE_EQ(joules(800, 1000), 100 * 500) << "the next one begins, an orbit after the first";
  EXPECT_DOUBLE_EQ(joules(0, 1200), 800 * 500) << "two orbits";
  const std::vector<std::pair<Time, Time>> lit{
      {Time{}, seconds(300)}, {seconds(500), seconds(900)}, {seconds(1100), seconds(1500)}};
  EXPECT_EQ(sunlight(*power.orbit, seconds(1200)), lit);
}

TEST(WorldEnergy, NeverRisesWithoutSun) {
  Flight run(flat_setup());
  run.drive(seconds(5), "d", "there", 40, 30);
  run.command(seconds(600), execute("i", "camera", "image", {{"image", "one"}}));
  run.advance(seconds(1000));
  run.command(seconds(1001), execute("t", "radio", "send", {{"image", "one"}}));
  run.advance(seconds(3000));
  ASSERT_EQ(run.stage("t"), Stage::completed);
  double last = 1e9;
  for (const Output& output : run.said) {
    const auto* seen = std::get_if<Observed>(&output);
    if (!seen || seen->timeline != "rover.battery") continue;
    const double energy = std::get<double>(seen->value);
    EXPECT_LT(energy, last);
    last = energy;
  }
}

TEST(WorldEnergy, IdlePowerIsWhatARestingRobotUses) {
  Flight run(flat_setup());
  run.advance(seconds(6000));
  EXPECT_NEAR(last_number(run.said, "rover.battery"), 500000 - 6000 * PowerParameters{}.idle_w, 1);
}

TEST(WorldEnergy, RisesInTheSun) {
  FlatSetup setup = flat_setup();
  setup.robot.power.solar_peak_w = 100;
  setup.robot.power.solar_noon_s = 3000;
  Flight run(setup);
  run.advance(seconds(6000));
  EXPECT_GT(last_number(run.said, "rover.battery"), 500000 + 6000 * 70.0);
}

TEST(WorldEnergy, AFlatBatteryFailsWhatRunsAndWhatComes) {
  FlatSetup setup = flat_setup();
  setup.robot.battery_j = 5000;  // about a minute of driving
  Flight run(setup);
  run.drive(seconds(1), "d", "there", 100, 20);
  Time now{};
  while (run.stage("d") == Stage::accepted) {
    now = run.world.next_change().value();
    run.advance(now);
  }
  EXPECT_EQ(run.time_of("d"), now) << "the change was announced in time";
  EXPECT_EQ(run.stage("d"), Stage::failed);
  EXPECT_EQ(run.code("d"), "battery-flat");
  EXPECT_LT(run.time_of("d"), seconds(90));
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"here"}}));
  run.command(now + seconds(1), execute("i", "camera", "image", {{"image", "one"}}));
  EXPECT_EQ(run.code("i"), "battery-flat");
}

TEST(WorldEnergy, ADropLeavesNoMoreThanItSays) {
  Flight run(flat_setup());
  run.disturb(seconds(10), EnergyDrop{"rover", 40000});
  run.advance(seconds(70));
  EXPECT_NEAR(last_number(run.said, "rover.battery"), 40000 - 50 * 14, 15 * 14);
  run.disturb(seconds(80), EnergyDrop{"rover", 400000});
  run.advance(seconds(140));
  EXPECT_LT(last_number(run.said, "rover.battery"), 40000) << "it gives nothing";
}

TEST(WorldEnergy, LossAtOnceIsNoticed) {
  Flight run(flat_setup());
  run.drive(seconds(1), "d", "there", 100, 20);
  run.disturb(seconds(10), EnergyLoss{"rover", 1e9});
  EXPECT_EQ(run.code("d"), "battery-flat");
  EXPECT_EQ(run.time_of("d"), seconds(10));
}

}  // namespace
}  // namespace roci::sim::world
