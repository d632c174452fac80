#include "pathplan_svc/rover_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace roci::pathplan {
namespace {

using testing::HasSubstr;

class RoverFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  Rover read(const std::string& section) {
    std::ofstream(file_) << "rover: {" << section << "}\n";
    return read_rover(mission::Entry::load(file_).at("rover"));
  }

  std::string error_of(const std::string& section) {
    try {
      read(section);
    } catch (const mission::FileError& e) {
      return e.what();
    }
    return "no error";
  }

  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                ("roci_rover_" + std::to_string(::getpid()) + "_" +
                                 testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
};

TEST_F(RoverFile, KeysReplaceDefaults) {
  const Rover rover = read("speed_m_s: 0.04, max_slope_deg: 30, keep_out: [{x: 1, y: 2, radius_m: 3}]");
  EXPECT_EQ(rover.drive.speed, 0.04);
  EXPECT_NEAR(rover.limits.max_slope, 0.5235987755982988, 1e-12);
  EXPECT_EQ(rover.limits.radius, RoverLimits{}.radius);
  EXPECT_THAT(rover.keep_out, testing::ElementsAre(Disc{{1, 2}, 3}));
}

TEST_F(RoverFile, KeepOutZonesAreDiscsAndPolygons) {
  const Rover rover =
      read("max_step_m: 0.2, keep_out: [{polygon: [[1, 2], [3, 2], [3, 5.5]]}, {x: 1, y: 2, radius_m: 3}]");
  EXPECT_EQ(rover.limits.max_step, 0.2);
  EXPECT_THAT(rover.keep_out, testing::ElementsAre(Disc{{1, 2}, 3}));
  EXPECT_THAT(rover.keep_out_polygons, testing::ElementsAre(terrain::Polygon{{{1, 2}, {3, 2}, {3, 5.5}}}));
  EXPECT_THAT(error_of("keep_out: [{polygon: [[1, 2], [3, 2]]}]"), HasSubstr("at least three corners"));
  EXPECT_THAT(error_of("keep_out: [{polygon: [[1, 2], [3, 2], [3]]}]"), HasSubstr("must be [x, y]"));
  EXPECT_THAT(error_of("keep_out: [{polygon: [[1, 2], [3, 2], [3, 1]], x: 1}]"),
              HasSubstr("unknown key 'x'"));
  EXPECT_THAT(error_of("max_step_m: -1"), HasSubstr("'max_step_m' is out of range"));
  EXPECT_EQ(error_of("max_step_m: 0"), "no error");
}

TEST_F(RoverFile, ErrorsNamePlaceAndRemedy) {
  EXPECT_THAT(error_of("sped_m_s: 1"),
              HasSubstr(".yaml:1:19: unknown key 'sped_m_s'; known here: keep_out, radius_m"));
  EXPECT_THAT(error_of("speed_m_s: 0"), HasSubstr(".yaml:1:20: 'speed_m_s' is out of range"));
  EXPECT_THAT(error_of("idle_power_w: -1"), HasSubstr("'idle_power_w' is out of range"));
  EXPECT_EQ(error_of("idle_power_w: 0"), "no error");
  EXPECT_THAT(error_of("drive_efficiency: 1.1"), HasSubstr("out of range"));
  EXPECT_THAT(error_of("mass_kg: .nan"), HasSubstr("expected a finite number"));
  EXPECT_THAT(error_of("keep_out: [{x: 1, y: 2, radius_m: -3}]"), HasSubstr("must not be negative"));
  EXPECT_THAT(error_of("keep_out: [{x: 1, radius_m: 3}]"), HasSubstr("'y' is missing"));
}

TEST_F(RoverFile, ARoverOfTooManyCellsIsRefused) {
  const auto error = [this](const std::string& text, double resolution) -> std::string {
    std::ofstream(file_) << text;
    const auto mission = mission::Entry::load(file_);
    const auto section = mission.find("rover");
    try {
      require_few_cells(section ? read_rover(*section) : Rover{}, {10, 10, resolution, {0, 0}}, mission);
    } catch (const mission::FileError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error("site: s.yaml\nrover: {radius_m: 2}\n", 0.02), "no error");
  EXPECT_THAT(
      error("site: s.yaml\nrover: {radius_m: 2}\n", 0.01),
      HasSubstr(".yaml:2:19: the rover's radius of 2 m is more than 100 cells of the site's map, whose side "
                "is 0.01 m; correct 'radius_m'"));
  EXPECT_THAT(error("site: s.yaml\n", 0.001), HasSubstr(".yaml:1:7: the rover's radius of 0.8 m"));
}

TEST_F(RoverFile, ThePlanetaryRoverIsRead) {
  const auto mission =
      mission::Entry::load(std::string(ROCI_SOURCE_DIR) + "/missions/planetary/mission.yaml");
  EXPECT_EQ(read_rover(mission.at("rover")).drive.mass, 150);
}

}  // namespace
}  // namespace roci::pathplan
