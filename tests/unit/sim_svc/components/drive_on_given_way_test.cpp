// A drive over the points that its command brings: no planner is asked, and what stops it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Request;
using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using testing::HasSubstr;

Request over(const std::string& activity, const std::string& way, const std::string& to = "there") {
  return execute(activity, "nav", "drive", {{"to", to}, {"way", way}});
}

bool asked_for_a_path(const Flight& run) {
  return std::ranges::any_of(run.said,
                             [](const auto& one) { return std::holds_alternative<world::PathWanted>(one); });
}

// How near the body came to a point, as it told of its places while it drove.
double gap(const Flight& run, double x, double y) {
  double least = INFINITY, at_x = 0;
  for (const world::Output& output : run.said) {
    const auto* seen = std::get_if<world::Observed>(&output);
    if (seen == nullptr) continue;
    if (seen->timeline == "rover.x") at_x = std::get<double>(seen->value);
    if (seen->timeline == "rover.y")
      least = std::min(least, std::hypot(at_x - x, std::get<double>(seen->value) - y));
  }
  return least;
}

Flight quiet_run() {
  FlatSetup flat;
  flat.robot.drive.motion.heading_noise = 0;
  return Flight(flat);
}

TEST(DriveOnGivenWay, LeadsOverEachPointAndEndsAtTheLastWithoutAPlanner) {
  Flight run = quiet_run();
  run.command(seconds(1), over("d", "20,20;30,20;30,30;40,30"));
  EXPECT_EQ(run.state("rover.nav"), (State{"going-to", {"there"}}));
  for (int s = 2; s < 600; ++s) run.advance(seconds(s));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_FALSE(asked_for_a_path(run));
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"there"}}));
  EXPECT_EQ(last_number(run.said, "rover.x"), 40);
  EXPECT_EQ(last_number(run.said, "rover.y"), 30);
  EXPECT_LT(gap(run, 30, 20), 1);
  EXPECT_LT(gap(run, 30, 30), 1);
}

TEST(DriveOnGivenWay, ThatLeadsBackToWhereItStandsIsDriven) {
  Flight run = quiet_run();
  run.command(seconds(1), over("d", "20,20;25,20;20,20"));
  run.advance(seconds(10));
  EXPECT_EQ(run.stage("d"), Stage::accepted);
  run.advance(seconds(400));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_GT(run.time_of("d"), seconds(90));
}

TEST(DriveOnGivenWay, OfTheOnePointWhereItStandsEndsAtOnce) {
  Flight run = quiet_run();
  run.command(seconds(1), over("d", "20,20"));
  run.advance(seconds(2));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"there"}}));
}

TEST(DriveOnGivenWay, TakesWhereTheWayEndsWhateverXAndYSay) {
  Flight run = quiet_run();
  Request both = over("d", "20,20;22,20");
  both.arguments.emplace("x", "90");
  both.arguments.emplace("y", "90");
  run.command(seconds(1), both);
  run.advance(seconds(100));
  EXPECT_EQ(last_number(run.said, "rover.x"), 22);
}

TEST(DriveOnGivenWay, ARockEndsItWithoutADetour) {
  FlatSetup flat;
  flat.ground.hidden_rocks = {{40, 20, 1}};
  flat.robot.drive.detours = 3;
  Flight run(flat);
  run.command(seconds(1), over("d", "20,20;60,20"));
  run.advance(seconds(500));
  EXPECT_EQ(run.stage("d"), Stage::failed);
  EXPECT_EQ(run.code("d"), "blocked");
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"here"}}));
  EXPECT_FALSE(asked_for_a_path(run));
  EXPECT_TRUE(std::ranges::any_of(
      run.said, [](const auto& one) { return std::holds_alternative<world::RockSeen>(one); }));
}

TEST(DriveOnGivenWay, ARockThatFallsOnItStopsIt) {
  Flight run(flat_setup());
  run.command(seconds(1), over("d", "20,20;60,20;60,40"));
  run.disturb(seconds(20), world::RockFall{{60, 30, 1}});
  run.advance(seconds(900));
  EXPECT_EQ(run.code("d"), "blocked");
  EXPECT_GT(last_number(run.said, "rover.x"), 55);
}

TEST(DriveOnGivenWay, FeelsTheSoilAndMarksNoGoAsOnAPlannedPath) {
  FlatSetup flat;
  flat.ground.surface.soil.soils["sand"].frictional_modulus = 2e5;
  flat.ground.surface.soil.areas = {{"sand", {}, 0, {{{30, 0}, {40, 0}, {40, 40}, {30, 40}}}}};
  flat.robot.drive.motion.weight_n = 180;
  flat.robot.drive.motion.wheels = 4;
  flat.robot.drive.motion.wheel_diameter_m = 0.4;
  flat.robot.drive.soil_sensor.vehicle = {2400, 6, 0.1, 0.3};
  flat.robot.drive.soil_sensor.instruments = {{"penetrometer", 0.5, 0, 0.25, 0.1, false}};
  Flight run(flat);
  run.command(seconds(1), over("d", "20,20;50,20"));
  run.advance(seconds(500));
  EXPECT_EQ(run.code("d"), "no-go");
  EXPECT_NEAR(last_number(run.said, "rover.x"), 29.5, 0.4);
}

TEST(DriveOnGivenWay, AFaultyWayIsRefusedWithThePlace) {
  Flight run(flat_setup());
  std::string long_way = "20,20";
  for (int i = 0; i < 64; ++i) long_way += ";20,20";
  int count = 0;
  for (const auto& [way, why] :
       std::map<std::string, std::string>{{"20,20;oak", "way: point 2 is not 'x,y'"},
                                          {"20,20;21,20;nan,20", "way: point 3 is not 'x,y'"},
                                          {"20,20;130,20", "way: point 2 (130,20) lies off the map"},
                                          {"-1,20", "way: point 1 (-1,20) lies off the map"},
                                          {"", "way: point 1 is not 'x,y'"},
                                          {long_way, "way: it has 65 points; a way has at most 64"}}) {
    const std::string id = "d" + std::to_string(++count);
    run.command(seconds(count), over(id, way));
    EXPECT_EQ(run.stage(id), Stage::failed);
    EXPECT_EQ(run.code(id), "bad-arguments");
    EXPECT_THAT(run.last_ack(id)->status.reason, HasSubstr(why));
  }
  run.command(seconds(10), over("fits", long_way.substr(6)));
  EXPECT_EQ(run.stage("fits"), Stage::completed);
}

TEST(DriveOnGivenWay, StandsInForXAndYAlone) {
  Flight run(flat_setup());
  run.command(seconds(1), execute("a", "nav", "drive", {{"way", "20,20;30,20"}}));
  EXPECT_EQ(run.stage("a"), Stage::rejected);
  EXPECT_THAT(run.last_ack("a")->status.reason, HasSubstr("needs the argument 'to'"));
  run.command(seconds(2), execute("b", "nav", "turn", {{"way", "20,20;30,20"}}));
  EXPECT_EQ(run.stage("b"), Stage::rejected);
}

TEST(DriveOnGivenWay, AStopLeavesItHere) {
  Flight run = quiet_run();
  run.command(seconds(1), over("d", "20,20;60,20"));
  run.command(seconds(60), execute("s", "nav", "stop"));
  EXPECT_EQ(run.stage("d"), Stage::cancelled);
  EXPECT_EQ(run.state("rover.nav"), (State{"idle-at", {"here"}}));
  EXPECT_GT(last_number(run.said, "rover.x"), 22);
}

}  // namespace
}  // namespace roci::sim::components
