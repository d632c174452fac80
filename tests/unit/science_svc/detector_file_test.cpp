#include "science_svc/detector_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace roci::science {
namespace {

using testing::HasSubstr;

class DetectorFile : public testing::Test {
 protected:
  mission::Entry load(const std::string& name, const std::string& text) {
    const auto file = folder_ / name;
    std::ofstream(file) << text;
    return mission::Entry::load(file);
  }
  DetectorSettings read(const std::string& mission, const std::string& scenario) {
    return read_detector(load("mission.yaml", mission), load("scenario.yaml", scenario));
  }
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("roci_detector_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(DetectorFile, TheScenarioOverridesTheMission) {
  const std::string mission = "science: {threshold: 0.5, goal_kind: look, min_interval_s: 60, limit: 2}\n";
  const DetectorSettings plain = read(mission, "duration_s: 1\n");
  EXPECT_TRUE(plain.enabled);
  EXPECT_EQ(plain.threshold, 0.5);
  EXPECT_EQ(plain.goal_kind, "look");
  EXPECT_EQ(plain.min_interval, temporal::seconds(60));
  EXPECT_EQ(plain.limit, 2);
  EXPECT_FALSE(read(mission, "science: {enabled: false}\n").enabled);
  EXPECT_EQ(read(mission, "science: {threshold: 0.9}\n").threshold, 0.9);
}

TEST_F(DetectorFile, ReadsTheCamera) {
  const DetectorSettings plain =
      read("science: {reach_m: 9, camera: {mast_m: 1.5, tilt_deg: 20, view_deg: 70}}\n", "x: 1\n");
  EXPECT_EQ(plain.reach_m, 9);
  EXPECT_EQ(plain.camera.mast_m, 1.5);
  EXPECT_EQ(plain.camera.tilt_deg, 20);
  EXPECT_EQ(plain.camera.view_deg, 70);
}

TEST_F(DetectorFile, AnOffsetIsAcceptedAndHasNoEffect) {
  const DetectorSettings old = read("science: {offset_m: 12}\n", "x: 1\n");
  ASSERT_EQ(old.warnings.size(), 1u);
  EXPECT_THAT(old.warnings[0], HasSubstr("mission.yaml:1:21: warning: 'offset_m' has no effect any more"));
  EXPECT_TRUE(read("science: {limit: 1}\n", "x: 1\n").warnings.empty());
}

TEST_F(DetectorFile, AMissionWithoutTheSectionHasNoDetector) {
  EXPECT_FALSE(read("name: m\n", "science: {enabled: true}\n").enabled);
}

TEST_F(DetectorFile, FaultsNameTheirPlace) {
  const auto error = [&](const std::string& mission, const std::string& scenario) -> std::string {
    try {
      read(mission, scenario);
    } catch (const mission::FileError& fault) {
      return fault.what();
    }
    return "no error";
  };
  EXPECT_THAT(error("science: {threshold: 2}\n", "x: 1\n"),
              HasSubstr("mission.yaml:1:22: 'threshold' must lie"));
  EXPECT_THAT(error("science: {treshold: 1}\n", "x: 1\n"), HasSubstr("mission.yaml:1:11: unknown key"));
  EXPECT_THAT(error("science: {limit: 1}\n", "science: {enabled: perhaps}\n"),
              HasSubstr("scenario.yaml:1:20"));
}

}  // namespace
}  // namespace roci::science
