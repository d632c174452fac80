#include "sim_svc/components/soil_sensor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim_svc/components/drive_settings.hpp"
#include "sim_svc/components/standard_types.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {
namespace {

using services::owner::Stage;
using temporal::seconds;
using testing::HasSubstr;

const WheeledVehicle kFollower{2400, 6, 0.1, 0.3};

SoilSensorSettings bevameter(double noise = 0) {
  SoilSensorSettings out;
  out.instruments = {{"wheel_bevameter", 0.1, 0, 0.05, noise, true}};
  out.judges_for = "primary";
  out.vehicle = kFollower;
  return out;
}

// A trap of radius 2 m at (30, 20), on flat ground or on a ramp.
world::Ground trapped(double frictional_modulus = 2e5, double grade = 0) {
  world::Ground ground{ramp_site(grade), {}};
  ground.surface.soil.soils["trap"].frictional_modulus = frictional_modulus;
  ground.surface.soil.areas = {{"trap", {30, 20}, 2, {}}};
  return ground;
}

std::optional<NoGo> sense_at(const SoilSensorSettings& settings, const world::Ground& ground, double x,
                             const std::vector<MarkedDisc>& known = {}, std::uint64_t seed = 1) {
  world::RandomStream noise(seed, "soil");
  SoilSensor sensor(settings, known, noise);
  return sensor.sense(ground, {x, 20, 0}, 0);
}

TEST(SoilSensor, SaysNoGoWhereItMeasuresAndNotBefore) {
  EXPECT_FALSE(sense_at(bevameter(), trapped(), 27.89));
  const auto no_go = sense_at(bevameter(), trapped(), 27.91);
  ASSERT_TRUE(no_go);
  EXPECT_NEAR(no_go->at.x, 28.01, 1e-9);
  EXPECT_FALSE(no_go->expected.bears);
}

TEST(SoilSensor, MeasuresBesideTheBodyToItsLeft) {
  SoilSensorSettings settings = bevameter();
  settings.instruments[0].beside_m = 0.5;
  world::RandomStream noise(1, "soil");
  const std::vector<MarkedDisc> known;
  const auto at_y = [&](double y, double heading) {
    SoilSensor sensor(settings, known, noise);
    return sensor.sense(trapped(), {30, y, heading}, 0);
  };
  ASSERT_TRUE(at_y(17.6, 0));  // the trap begins at 18, to the left of who drives east
  EXPECT_NEAR(at_y(17.6, 0)->at.y, 18.1, 1e-9);
  EXPECT_FALSE(at_y(17.4, 0));
  EXPECT_FALSE(at_y(17.6, std::numbers::pi)) << "of who drives west it is to the right";
  ASSERT_TRUE(at_y(22.4, std::numbers::pi));
  EXPECT_NEAR(at_y(22.4, std::numbers::pi)->at.x, 29.9, 1e-9);
}

TEST(SoilSensor, JudgesByTheFootingOfTheVehicleThatIsToFollow) {
  EXPECT_FALSE(sense_at(bevameter(), trapped(3e6), 29)) << "firm sand bears it";
  SoilSensorSettings light = bevameter();
  light.vehicle = {180, 4, 0.06, 0.4};
  EXPECT_FALSE(sense_at(light, trapped(), 29)) << "a light one may go there";
  SoilSensorSettings careful = light;
  careful.most_sinkage_share = 0.05;
  EXPECT_TRUE(sense_at(careful, trapped(), 29));
}

TEST(SoilSensor, ASlopeMakesItWorse) {
  EXPECT_FALSE(sense_at(bevameter(), trapped(3e6), 29));
  EXPECT_TRUE(sense_at(bevameter(), trapped(3e6, 0.4), 29));
}

TEST(SoilSensor, APenetrometerTakesTheStrengthOnTrust) {
  world::Ground weak = trapped(3e6);
  weak.surface.soil.soils["trap"].friction_deg = 3;
  weak.surface.soil.soils["trap"].cohesion_pa = 0;
  EXPECT_TRUE(sense_at(bevameter(), weak, 29));
  SoilSensorSettings penetrometer = bevameter();
  penetrometer.instruments[0].shears = false;
  EXPECT_FALSE(sense_at(penetrometer, weak, 29));
  EXPECT_TRUE(sense_at(penetrometer, trapped(), 29)) << "that it gives way it does measure";
}

TEST(SoilSensor, MeasuresOnceInSoMuchWay) {
  SoilSensorSettings settings = bevameter();
  settings.instruments[0].every_m = 0.5;
  const std::vector<MarkedDisc> known{{{30, 20}, 3}};
  world::RandomStream noise(1, "soil");
  SoilSensor sensor(settings, known, noise);
  const world::Ground ground = trapped();
  for (int i = 0; i <= 100; ++i) EXPECT_FALSE(sensor.sense(ground, {29, 20, 0}, i == 0 ? 0 : 0.02));
  EXPECT_EQ(sensor.record().samples, 5);  // at 0, 0.5, 1, 1.5 and 2 m
  EXPECT_LE(sensor.record().least_margin, 0);
}

TEST(SoilSensor, WhatIsMarkedAlreadyIsNoNews) {
  EXPECT_FALSE(sense_at(bevameter(), trapped(), 29, {{{29, 20}, 0.5}}));
  EXPECT_TRUE(sense_at(bevameter(), trapped(), 29, {{{26, 20}, 0.5}}));
}

// Soil at the limit: without noise always the same verdict, with noise now this and now that.
TEST(SoilSensor, NoiseMakesAVerdictAtTheLimitUncertain) {
  SoilSensorSettings settings = bevameter(0.3);
  int no_go = 0;
  double limit = 2e5;
  while (sense_at(bevameter(), trapped(limit), 29)) limit *= 1.02;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    no_go += sense_at(settings, trapped(limit), 29, {}, seed).has_value() ? 1 : 0;
  EXPECT_GT(no_go, 50);
  EXPECT_LT(no_go, 150);
}

FlatSetup scout_before_a_trap() {
  FlatSetup flat;
  flat.ground = trapped();
  flat.robot.drive.motion.weight_n = 180;
  flat.robot.drive.motion.wheels = 4;
  flat.robot.drive.motion.wheel_width_m = 0.06;
  flat.robot.drive.motion.wheel_diameter_m = 0.4;
  flat.robot.drive.soil_sensor = bevameter(0.05);
  return flat;
}

TEST(DriveWithSoilSensor, EndsWithNoGoWhereItIsSafeItself) {
  Flight run(scout_before_a_trap());
  run.drive(seconds(1), "d", "there", 40, 20);
  run.advance(seconds(400));
  EXPECT_EQ(run.code("d"), "no-go");
  EXPECT_THAT(run.last_ack("d")->status.reason, HasSubstr("wheel_bevameter says No-Go for primary"));
  EXPECT_EQ(run.state("rover.nav"), (temporal::State{"idle-at", {"here"}}));
  std::vector<world::SoilMarked> marked;
  for (const world::Output& output : run.said)
    if (const auto* soil = std::get_if<world::SoilMarked>(&output)) marked.push_back(*soil);
  ASSERT_EQ(marked.size(), 1U);
  EXPECT_EQ(marked[0].id, "rover-soil-1");
  EXPECT_NEAR(marked[0].x, 28.03 + 1.5, 0.05) << "the circle lies ahead of the body";
  EXPECT_EQ(marked[0].radius, 1.5);
  EXPECT_EQ(marked[0].at, run.time_of("d"));
  EXPECT_GT(std::get<double>(run.last_ack("d")->status.results.values.at("soil_samples")), 0);

  run.drive(seconds(500), "e", "away", 20, 20);
  run.advance(seconds(900));
  EXPECT_EQ(run.stage("e"), Stage::completed) << "it drives on; the marked circle is no news";
}

TEST(DriveWithSoilSensor, WithoutOneNothingIsMarkedAndTheNoiseOfTheDriveStays) {
  FlatSetup with = scout_before_a_trap();
  with.ground.surface.soil.areas.clear();
  FlatSetup without = with;
  without.robot.drive.soil_sensor = {};
  Flight a(with), b(without);
  for (Flight* run : {&a, &b}) {
    run->drive(seconds(1), "d", "there", 40, 20);
    run->advance(seconds(400));
  }
  EXPECT_EQ(a.time_of("d"), b.time_of("d"));
}

std::string sensor_error(const std::string& sensor) {
  const auto mission =
      mission::Entry::parse("nav: {name: nav, type: drive, soil_sensor: " + sensor + "}\n", "mission.yaml");
  const std::map<std::string, mission::Entry> conditions;
  setup::Settings settings(mission, mission.at("nav"), std::nullopt, conditions);
  try {
    read_drive_settings(settings);
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DriveWithSoilSensor, SettingsAreReadAndRefusedWithTheirPlace) {
  const std::string vehicle =
      "for: {name: primary, weight_n: 2400, wheels: 6, wheel_width_m: 0.1, wheel_diameter_m: 0.3}";
  EXPECT_EQ(sensor_error("{" + vehicle + ", instruments: [{name: wheel_bevameter, ahead_m: 0.2}]}"),
            "no error");
  EXPECT_THAT(sensor_error("{" + vehicle + ", instruments: []}"), HasSubstr("the sensor has no instrument"));
  EXPECT_THAT(sensor_error("{" + vehicle + ", instruments: [{name: a, every_m: 0}]}"),
              HasSubstr("'every_m' must be at least"));
  EXPECT_THAT(sensor_error("{for: {weight_n: 2400}, instruments: [{name: a}]}"),
              HasSubstr("mission.yaml:1:"));
  EXPECT_THAT(sensor_error("{instruments: [{name: a}]}"), HasSubstr("for"));
}

}  // namespace
}  // namespace roci::sim::components
