#include "sim_svc/components/marker_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Stage;
using temporal::seconds;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

MarkerCameraSettings sharp() {
  MarkerCameraSettings out;
  out.miss_share = out.range_noise = out.heading_noise_rad = 0;
  return out;
}

std::string unseen(const world::Pose& from, const world::Pose& to,
                   const world::Ground& ground = {flat_site(), {}}) {
  return why_unseen(ground, sharp(), from, to);
}

TEST(MarkerCamera, SeesWithinItsRangeAndItsField) {
  EXPECT_EQ(unseen({20, 20, 0}, {25, 20, 0}), "");
  EXPECT_THAT(unseen({20, 20, 0}, {28.1, 20, 0}), HasSubstr("farther"));
  EXPECT_THAT(unseen({20, 20, 0}, {20.4, 20, 0}), HasSubstr("nearer"));
  EXPECT_EQ(unseen({20, 20, 0}, {24, 23.9, 0}), "") << "just under 45 degrees";
  EXPECT_THAT(unseen({20, 20, 0}, {24, 24.1, 0}), HasSubstr("field of view"));
  EXPECT_EQ(unseen({20, 20, kPi}, {15, 20, 0}), "") << "it looks where the body heads";
  EXPECT_THAT(unseen({20, 20, kPi}, {25, 20, 0}), HasSubstr("field of view"));
}

TEST(MarkerCamera, RocksOfTheMapAndHiddenOnesHideIt) {
  const world::Pose from{20, 20, 0}, to{26, 20, 0};
  EXPECT_THAT(unseen(from, to, {flat_site(), {{23, 20, 1.5}}}), HasSubstr("hides it"));
  EXPECT_EQ(unseen(from, to, {flat_site(), {{23, 23, 1.5}}}), "");
  terrain::SiteLayers layers = flat_site()->layers();
  layers.rock_height[flat_site()->grid().index({23, 20})] = 1.4F;
  const world::Ground rocky{std::make_shared<terrain::Site>(flat_site()->grid(), layers), {}};
  EXPECT_THAT(unseen({20, 20.5, 0}, {26, 20.5, 0}, rocky), HasSubstr("hides it"));
}

TEST(MarkerCamera, AHillHidesIt) {
  terrain::SiteLayers layers = flat_site()->layers();
  const terrain::Grid grid = flat_site()->grid();
  for (int row = 0; row < grid.rows; ++row) layers.elevation[grid.index({23, row})] = 2;
  const world::Ground hill{std::make_shared<terrain::Site>(grid, layers), {}};
  EXPECT_THAT(unseen({20, 20, 0}, {27, 20, 0}, hill), HasSubstr("hides it"));
}

world::WorldSetup two_rovers(const MarkerCameraSettings& camera, double x = 24) {
  FlatSetup first, second;
  second.robot.name = "scout";
  second.robot.start = {x, 21, 1};
  world::WorldSetup setup = first.build();
  setup.robots[0].components.push_back(part<MarkerCamera>("eye", "marker_camera", camera));
  setup.robots.push_back(second.robot.build());
  return setup;
}

services::owner::Request look(const std::string& activity, const std::string& whom = "scout") {
  auto request = execute(activity, "eye", "localise", {{"robot", whom}});
  request.robot = "rover";
  return request;
}

double result(const Flight& run, const std::string& activity, const std::string& name) {
  return std::get<double>(run.last_ack(activity)->status.results.values.at(name));
}

TEST(MarkerCamera, TellsWhereTheOtherStands) {
  Flight run(two_rovers(sharp()));
  run.command(seconds(1), look("l"));
  EXPECT_EQ(run.state("rover.eye"), (temporal::State{"looking", {}}));
  run.advance(seconds(7));
  ASSERT_EQ(run.stage("l"), Stage::completed);
  EXPECT_EQ(run.time_of("l"), seconds(6));
  EXPECT_EQ(result(run, "l", "x"), 24);
  EXPECT_EQ(result(run, "l", "y"), 21);
  EXPECT_EQ(result(run, "l", "heading"), 1);
}

TEST(MarkerCamera, SaysSoWhereItIsNotSeen) {
  Flight run(two_rovers(sharp(), 40));
  run.command(seconds(1), look("l"));
  run.advance(seconds(7));
  EXPECT_EQ(run.code("l"), "marker-not-seen");
  EXPECT_TRUE(run.last_ack("l")->status.results.values.empty());
  run.command(seconds(8), look("m", "third"));
  EXPECT_EQ(run.code("m"), "unknown-robot");
  run.command(seconds(9), look("n", "rover"));
  EXPECT_EQ(run.code("n"), "unknown-robot") << "not itself";
}

TEST(MarkerCamera, LooksWhereTheOtherStandsNow) {
  Flight run(two_rovers(sharp(), 40));
  run.drive(seconds(1), "d", "near", 25, 20, "scout");
  run.advance(seconds(600));
  ASSERT_EQ(run.stage("d"), Stage::completed);
  run.command(seconds(600), look("l"));
  run.advance(seconds(610));
  ASSERT_EQ(run.stage("l"), Stage::completed);
  EXPECT_EQ(result(run, "l", "x"), 25);
}

TEST(MarkerCamera, NoiseGrowsWithTheRangeAndSomeImagesMiss) {
  MarkerCameraSettings camera = sharp();
  camera.range_noise = 0.05;
  camera.miss_share = 0.3;
  int missed = 0, seen = 0;
  double squared = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Flight run(two_rovers(camera), seed);
    run.command(seconds(1), look("l"));
    run.advance(seconds(7));
    if (run.code("l") == "marker-not-seen") {
      ++missed;
      continue;
    }
    ++seen;
    squared += std::pow(result(run, "l", "x") - 24, 2);
  }
  EXPECT_NEAR(missed, 60, 25);
  EXPECT_NEAR(std::sqrt(squared / seen), 0.05 * std::hypot(4, 1), 0.05);
}

TEST(MarkerCamera, NoLookWhileDrivingAndNoDriveWhileLooking) {
  Flight run(two_rovers(sharp()));
  run.command(seconds(1), look("l"));
  auto drive = drive_to("d", "there", 30, 20);
  drive.robot = "rover";
  run.command(seconds(2), drive);
  EXPECT_EQ(run.code("d"), "camera-busy");
  run.advance(seconds(10));
  run.drive(seconds(10), "e", "there", 30, 20, "rover");
  run.command(seconds(20), look("m"));
  EXPECT_EQ(run.code("m"), "driving");
}

// Turning in place, towards a point.
TEST(DriveTurn, TurnsInPlaceTowardsAPoint) {
  FlatSetup flat;
  flat.robot.drive.motion.heading_noise = 0;
  Flight run(flat);
  run.command(seconds(1), execute("t", "nav", "turn", {{"x", "20"}, {"y", "30"}}));
  EXPECT_EQ(run.state("rover.nav"), (temporal::State{"going-to", {"here"}}));
  run.advance(seconds(60));
  ASSERT_EQ(run.stage("t"), Stage::completed);
  EXPECT_NEAR(temporal::to_seconds(run.time_of("t")), 1 + kPi / 2 / 0.19, 0.11);
  EXPECT_NEAR(last_number(run.said, "rover.heading"), kPi / 2, 1e-3);
  EXPECT_EQ(last_number(run.said, "rover.x"), 20);
  EXPECT_EQ(run.state("rover.nav"), (temporal::State{"idle-at", {"here"}}));
  EXPECT_NEAR(run.last_ack("t")->status.results.energy_j.value(), 55 * kPi / 2 / 0.19, 6);
}

TEST(DriveTurn, ItStandsWhereItStoodUnderTheSameName) {
  Flight run(flat_setup());
  run.drive(seconds(1), "d", "there", 25, 20);
  run.advance(seconds(200));
  run.command(seconds(200), execute("t", "nav", "turn", {{"x", "25"}, {"y", "10"}}));
  run.command(seconds(202), execute("s", "nav", "stop", {}));
  EXPECT_EQ(run.stage("t"), Stage::cancelled);
  EXPECT_EQ(run.state("rover.nav"), (temporal::State{"idle-at", {"there"}}));
  run.advance(seconds(203));
  EXPECT_LT(last_number(run.said, "rover.heading"), -0.2);
  run.command(seconds(210), execute("u", "nav", "turn", {{"x", "north"}, {"y", "10"}}));
  EXPECT_EQ(run.code("u"), "bad-arguments");
}

}  // namespace
}  // namespace roci::sim::components
