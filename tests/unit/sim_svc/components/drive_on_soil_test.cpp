// A drive over soil that no map shows: slower, dearer, and where it does not bear, the end of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Stage;
using temporal::seconds;
using temporal::Time;
using temporal::to_seconds;

DriveParameters heavy() {
  DriveParameters p;
  p.weight_n = 2400;
  p.wheels = 6;
  return p;
}

DriveParameters light() {
  DriveParameters p;
  p.weight_n = 180;
  p.wheels = 4;
  p.wheel_width_m = 0.06;
  p.wheel_diameter_m = 0.4;
  return p;
}

// Dry sand, or a trap, in x 30 … 40.
world::Ground ground_with(double frictional_modulus) {
  world::Ground ground{flat_site(), {}};
  ground.surface.soil.soils["sand"].frictional_modulus = frictional_modulus;
  ground.surface.soil.areas = {{"sand", {}, 0, {{{30, 0}, {40, 0}, {40, 40}, {30, 40}}}}};
  return ground;
}

DriveTrace drive(const world::Ground& ground, const DriveParameters& parameters) {
  world::RandomStream noise(1, "drive");
  return simulate_drive(ground, parameters, Time{}, {20, 20, 0}, {{50, 20}}, 0, noise);
}

TEST(DriveOnSoil, SandIsSlowerAndDearerThanFirmGround) {
  const DriveTrace firm = drive({flat_site(), {}}, heavy());
  const DriveTrace sand = drive(ground_with(1528430), heavy());
  ASSERT_EQ(sand.outcome, DriveEnd::arrived);
  EXPECT_GT(to_seconds(sand.end), 1.02 * to_seconds(firm.end));
  EXPECT_GT(sand.samples.back().energy_j, 1.1 * firm.samples.back().energy_j);
  EXPECT_NEAR(sand.deepest_sinkage_m, 0.047, 1e-3);
  EXPECT_EQ(firm.deepest_sinkage_m, 0);
}

TEST(DriveOnSoil, ABodyOfWhichNoWheelsAreKnownFeelsNone) {
  DriveParameters blind = heavy();
  blind.wheels = 0;
  const DriveTrace firm = drive({flat_site(), {}}, blind);
  const DriveTrace trap = drive(ground_with(2e5), blind);
  EXPECT_EQ(firm.end, trap.end);
  EXPECT_EQ(firm.samples.back().energy_j, trap.samples.back().energy_j);
  EXPECT_EQ(firm.samples.back().pose, trap.samples.back().pose);
}

TEST(DriveOnSoil, ATrapHoldsTheHeavyOneAtItsEdgeAndNotTheLightOne) {
  const DriveTrace held = drive(ground_with(2e5), heavy());
  ASSERT_EQ(held.outcome, DriveEnd::bogged);
  EXPECT_NEAR(held.samples.back().pose.x, 30, 0.05);
  EXPECT_EQ(drive(ground_with(2e5), light()).outcome, DriveEnd::arrived);
}

FlatSetup trap_on_the_way() {
  FlatSetup flat;
  flat.ground = ground_with(2e5);
  flat.robot.drive.motion = heavy();
  return flat;
}

TEST(DriveOnSoil, WhatIsDugInSaysSoAndDrivesNoMore) {
  Flight run(trap_on_the_way());
  run.drive(seconds(1), "d", "there", 50, 20);
  run.advance(seconds(400));
  EXPECT_EQ(run.code("d"), "bogged-down");
  EXPECT_EQ(run.stage("d"), Stage::failed);
  EXPECT_NEAR(std::get<double>(run.last_ack("d")->status.results.values.at("sinkage")), 0.15, 1e-9);
  run.command(seconds(500), drive_to("e", "back", 20, 20));
  EXPECT_EQ(run.code("e"), "bogged-down");
  EXPECT_EQ(run.stage("e"), Stage::failed);
}

TEST(DriveOnSoil, WhatIsDugInIsSoStillWhenItsProcessComesBack) {
  Flight run(trap_on_the_way());
  run.drive(seconds(1), "d", "there", 50, 20);
  run.advance(seconds(400));
  world::World again(trap_on_the_way().build(), 1);
  again.restore(run.world.memory());
  const auto said =
      again.begin(seconds(401), {"", "nav", {{"e", 1}, "drive", {{"to", "a"}, {"x", "1"}, {"y", "1"}}}});
  const bool refused = std::ranges::any_of(said, [](const world::Output& one) {
    const auto* report = std::get_if<world::TaskReport>(&one);
    return report && report->code == "bogged-down";
  });
  EXPECT_TRUE(refused);
}

TEST(DriveOnSoil, SoilThatComesUnderARunningDriveIsFelt) {
  FlatSetup flat = trap_on_the_way();
  const world::SoilArea area = flat.ground.surface.soil.areas.front();
  flat.ground.surface.soil.areas.clear();
  Flight run(flat);
  run.drive(seconds(1), "d", "there", 50, 20);
  run.disturb(seconds(20), world::SoilChange{area});
  run.advance(seconds(400));
  EXPECT_EQ(run.code("d"), "bogged-down");
}

}  // namespace
}  // namespace roci::sim::components
