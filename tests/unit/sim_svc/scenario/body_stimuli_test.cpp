// What may befall a robot's energy, heat, rate and view, as a scenario says it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_svc/scenario/body_stimuli_file.hpp"
#include "sim_svc/scenario/run_file.hpp"

namespace roci::sim::scenario {
namespace {

using temporal::seconds;
using testing::HasSubstr;

class BodyStimuli : public testing::Test {
 protected:
  RunSetup load(const std::string& stimulus, const std::string& extra = "") {
    std::ofstream(folder_ / "mission.yaml")
        << "windows: [{timeline: earth.window, open: [[0, 5]]}]\nsimulation:\n  robots:\n    - name: lander\n"
           "      power: {}\n      thermal: {zones: {dish: {}}}\n      data: {}\n      components:\n"
           "        - {name: radio, type: direct_radio, zone: dish}\n"
           "        - {name: camera, type: survey_camera, products: {panorama: {panorama: {tier: mandatory, "
           "bytes: "
           "100}, preview: {tier: critical, bytes: 10}}}}\n"
           "        - {name: seismometer, type: seismometer, products: {quakes: {bytes: 50}}}\n" +
               extra;
    std::ofstream(folder_ / "scenarios/nominal.yaml")
        << "duration_s: 99\nstart: {battery: 5}\n" + stimulus + "\n";
    return load_run(folder_, "nominal");
  }
  world::Disturbance disturbance(const std::string& stimulus) {
    return std::get<world::Disturbance>(
        load("stimuli: [{at_s: 3, " + stimulus + "}]").scenario.stimuli.at(0).what);
  }
  std::string error_of(const std::string& stimulus, const std::string& extra = "") {
    try {
      load(stimulus.starts_with("world") ? stimulus : "stimuli:\n  - {at_s: 3, " + stimulus + "}", extra);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_stimuli_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(BodyStimuli, SayWhatBefallsARobot) {
  EXPECT_EQ(std::get<world::EnergyDrop>(disturbance("battery_to_j: 7")).to_j, 7);
  EXPECT_EQ(std::get<world::SurroundingsChange>(disturbance("surroundings: {kelvin: 85}")).kelvin, 85);
  const auto heat = std::get<world::SuddenHeat>(disturbance("heat: {zone: dish, joules: -300}"));
  EXPECT_EQ(heat.zone, "dish");
  EXPECT_EQ(heat.joules, -300);
  const auto rate = std::get<world::RateChange>(disturbance("rate: {component: radio, factor: 0.1}"));
  EXPECT_EQ(rate.component, "radio");
  EXPECT_EQ(rate.factor, 0.1);
  const auto block =
      std::get<world::ViewBlock>(disturbance("blocked_view: {window: earth.window, for_s: 20}"));
  EXPECT_EQ(block.until, seconds(23));
}

TEST_F(BodyStimuli, WhatCannotBeIsRefusedWithItsPlace) {
  EXPECT_THAT(error_of("battery_to_j: -1"), HasSubstr("nominal.yaml:4:"));
  EXPECT_THAT(error_of("surroundings: {kelvin: 0}"), HasSubstr("correct the number"));
  EXPECT_THAT(error_of("heat: {zone: dihs, joules: 1}"), HasSubstr("known: dish; did you mean 'dish'"));
  EXPECT_THAT(error_of("rate: {component: camera, factor: 2}"), HasSubstr("has no rate"));
  EXPECT_THAT(error_of("rate: {component: radio, factor: 0}"), HasSubstr("at least"));
  EXPECT_THAT(error_of("rate: {component: nobody, factor: 1}"), HasSubstr("unknown component"));
  EXPECT_THAT(error_of("blocked_view: {window: mars.window, for_s: 1}"),
              HasSubstr("no window 'mars.window'"));
  EXPECT_THAT(error_of("surroundings: {kelvin: 85}, battery_to_j: 3"), HasSubstr("split it"));
}

TEST_F(BodyStimuli, SettingsOfTheLandersPartsAreChecked) {
  const std::string part = "        - {name: other, type: ";
  EXPECT_EQ(error_of("battery_to_j: 1"), "no error");
  EXPECT_THAT(error_of("battery_to_j: 1", part + "direct_radio, zone: dihs}\n"),
              HasSubstr("works in the zone 'dihs', which 'lander' has not; known: dish"));
  EXPECT_THAT(error_of("battery_to_j: 1", part + "direct_radio, rate_noise: 2}\n"), HasSubstr("is a share"));
  EXPECT_THAT(error_of("battery_to_j: 1", part + "survey_camera, products: {look: {}}}\n"),
              HasSubstr("no command 'look'; known: find_sites, find_targets, panorama"));
  EXPECT_THAT(error_of("battery_to_j: 1", part + "survey_camera, panorama: {heat_w: 500}}\n"),
              HasSubstr("no more heat than it draws"));
  EXPECT_THAT(error_of("battery_to_j: 1", part + "seismometer, quakes_per_day: 1e9}\n"),
              HasSubstr("one in ten"));
  EXPECT_THAT(error_of("world: {data_factor: {urgent: 2}}"), HasSubstr("unknown tier 'urgent'"));
  EXPECT_THAT(error_of("world: {data_factor: 0}"), HasSubstr("between 0.001 and 1000"));
}

// Makes a panorama and parks the seismometer, and returns the sizes.
TEST_F(BodyStimuli, AScenarioMayBringMoreDataOfATier) {
  const auto bytes = [&](const std::string& conditions) {
    auto run = load(conditions);
    run.world.robots[0].power.reset();
    run.world.robots[0].thermal.reset();
    world::World sim(std::move(run.world), 1);
    std::map<std::string, std::uint64_t> out;
    world::Outputs said = sim.begin(seconds(1), {"", "camera", {{"p", 1}, "panorama", {}, {}}});
    for (const world::Output& output : sim.advance(seconds(9000)))
      if (const auto* product = std::get_if<world::Product>(&output)) out[product->kind] = product->bytes;
    return out;
  };
  EXPECT_EQ(bytes(""), (std::map<std::string, std::uint64_t>{{"panorama", 100}, {"preview", 10}}));
  EXPECT_EQ(bytes("world: {data_factor: {mandatory: 3}}"),
            (std::map<std::string, std::uint64_t>{{"panorama", 300}, {"preview", 10}}));
  EXPECT_EQ(bytes("world: {data_factor: 2}"),
            (std::map<std::string, std::uint64_t>{{"panorama", 200}, {"preview", 20}}));
}

}  // namespace
}  // namespace roci::sim::scenario
