// What mission.yaml and a scenario's world say of power, heat and data on board.
#include "sim_svc/scenario/body_conditions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sim_svc/scenario/run_file.hpp"

namespace roci::sim::scenario {
namespace {

using testing::HasSubstr;

class BodyConditions : public testing::Test {
 protected:
  RunSetup load(const std::string& body, const std::string& world = "") {
    std::ofstream(folder_ / "mission.yaml")
        << "simulation:\n  robots:\n    - name: lander\n      components: []\n" + body;
    std::ofstream(folder_ / "scenarios/nominal.yaml")
        << "duration_s: 9\nstart: {battery: 5}\n" + (world.empty() ? "" : "world: " + world + "\n");
    return load_run(folder_, "nominal");
  }
  std::string error_of(const std::string& body, const std::string& world = "") {
    try {
      load(body, world);
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "no error";
  }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_body_") + test->name());
    std::filesystem::create_directories(folder_ / "scenarios");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  static constexpr const char* kPower = "      power: {capacity_j: 100, use_factor: 1.05}\n";
  static constexpr const char* kHeat =
      "      thermal:\n        surroundings_k: 90\n        zones:\n"
      "          arm: {capacity_j_k: 9000, loss_w_k: 0.3, heater_w: 80, keep_k: 140, work_k: 210, range_k: "
      "[130, 320]}\n"
      "          dish: {keep_k: 120, start_k: 110}\n";
};

TEST_F(BodyConditions, AMissionSaysWhatABodyIs) {
  const auto run = load(std::string(kPower) + kHeat + "      data: {capacity_bytes: 5e8}\n");
  const world::RobotSetup& lander = run.world.robots.at(0);
  EXPECT_EQ(lander.power->parameters.use_factor, 1.05);
  EXPECT_EQ(lander.data_bytes, 5e8);
  ASSERT_EQ(lander.thermal->zones.size(), 2u);
  EXPECT_EQ(lander.thermal->surroundings_k, 90);
  const world::ZoneParameters& arm = lander.thermal->zones[0];
  EXPECT_EQ(arm.name, "arm");
  EXPECT_EQ(arm.capacity_j_k, 9000);
  EXPECT_EQ(arm.work_k, 210);
  EXPECT_EQ(arm.most_k, 320);
  EXPECT_EQ(arm.start_k, 140) << "by default what it is kept at";
  EXPECT_EQ(lander.thermal->zones[1].start_k, 110);
}

TEST_F(BodyConditions, AScenarioSaysOtherwise) {
  const auto run =
      load(std::string(kPower) + kHeat + "      data: {}\n",
           "{use_factor: 1.1, gauge: {below_j: 50, factor: 2}, surroundings_k: 85, waste_factor: 1.5, "
           "loss_factor: 0.5, data_capacity_bytes: 1000}");
  const world::RobotSetup& lander = run.world.robots.at(0);
  EXPECT_EQ(lander.power->parameters.use_factor, 1.1);
  EXPECT_EQ(lander.power->parameters.gauge.below_j, 50);
  EXPECT_EQ(lander.thermal->surroundings_k, 85);
  EXPECT_EQ(lander.thermal->waste_factor, 1.5);
  EXPECT_EQ(lander.thermal->loss_factor, 0.5);
  EXPECT_EQ(lander.data_bytes, 1000);
}

TEST_F(BodyConditions, RefusesWhatCannotBe) {
  EXPECT_THAT(error_of(kPower, "{surroundings_k: 85}"),
              HasSubstr("nominal.yaml:3:25: no robot has 'thermal'"));
  EXPECT_THAT(error_of(kPower, "{data_capacity_bytes: 85}"), HasSubstr("no robot has 'data'"));
  EXPECT_THAT(error_of(kPower, "{use_factr: 1}"), HasSubstr("did you mean 'use_factor'"));
  EXPECT_THAT(error_of(std::string(kPower) + kHeat, "{surroundings_k: -3}"), HasSubstr("nominal.yaml:3:"));
  EXPECT_THAT(error_of(std::string(kPower) + kHeat, "{loss_factor: 0}"), HasSubstr("at least"));
  EXPECT_THAT(error_of("      power: {gauge: {under_j: 1}}\n"), HasSubstr("mission.yaml:5:"));
  EXPECT_THAT(error_of("      data: {capacity_bytes: 0}\n"), HasSubstr("at least"));
  const std::string zones = std::string(kPower) + "      thermal: {zones: ";
  EXPECT_THAT(error_of(zones + "{a: {work_k: 100, keep_k: 120}}}\n"),
              HasSubstr("colder at work than at rest"));
  EXPECT_THAT(error_of(zones + "{a: {range_k: [200, 300]}}}\n"), HasSubstr("the heater itself would leave"));
  EXPECT_THAT(error_of(zones + "{a.b: {}}}\n"), HasSubstr("no name for a timeline"));
  EXPECT_THAT(error_of(zones + "{a: {loss_w_k: 0}}}\n"), HasSubstr("at least"));
}

}  // namespace
}  // namespace roci::sim::scenario
