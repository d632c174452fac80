#include "core/terrain/site_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "core/terrain/pgm.hpp"

namespace roci::terrain {
namespace {

using testing::HasSubstr;

class SiteFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("roci_site_file_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    write("rocks.pgm", to_pgm({3, 2, 255, {0, 255, 255, 255, 128, 255}}, ""));
    write("elevation.pgm", to_pgm({3, 2, 65535, {0, 0, 65535, 0, 0, 0}}, ""));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  // The standard keys, with `from` replaced by `to`.
  std::filesystem::path description(const std::string& from = "", const std::string& to = "") {
    std::string text =
        "image: rocks.pgm\nresolution: 0.5\norigin: [10, 20, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
        "free_thresh: 0.2\nelevation: {image: elevation.pgm, min: -2, max: 4}\n";
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    write("site.yaml", text);
    return folder_ / "site.yaml";
  }

  std::string error_after(const std::string& from, const std::string& to) {
    try {
      load_site(description(from, to));
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(SiteFile, TheTopOfTheImageIsNorth) {
  const Site site = load_site(description());
  EXPECT_EQ(site.grid(), (Grid{3, 2, 0.5, {10, 20}}));
  EXPECT_EQ(site.occupancy(Cell{0, 1}), Occupancy::occupied);
  EXPECT_EQ(site.occupancy(Cell{1, 0}), Occupancy::unknown);
  EXPECT_EQ(site.occupancy(Cell{2, 0}), Occupancy::free);
  EXPECT_EQ(site.rock_height(Cell{0, 1}), 1.0);
  EXPECT_EQ(site.elevation(Cell{2, 1}), 4.0);
  EXPECT_EQ(site.elevation(Cell{0, 0}), -2.0);
}

TEST_F(SiteFile, NegatedImagesAreReadTheOtherWayRound) {
  const Site site = load_site(description("negate: 0", "negate: 1"));
  EXPECT_EQ(site.occupancy(Cell{0, 1}), Occupancy::free);
  EXPECT_EQ(site.occupancy(Cell{2, 1}), Occupancy::occupied);
}

TEST_F(SiteFile, ScaleModeGivesRocksOfEveryHeight) {
  const Site site = load_site(description("negate: 0", "negate: 0\nmode: scale\nrocks: {max_height: 2}"));
  EXPECT_NEAR(site.rock_height(Cell{1, 0}), 2 * 127.0 / 255, 1e-6);
  EXPECT_EQ(site.occupancy(Cell{1, 0}), Occupancy::free);
  EXPECT_EQ(site.rock_height(Cell{0, 1}), 2.0);
}

TEST_F(SiteFile, WithoutElevationTheSiteIsFlat) {
  const Site site = load_site(description("elevation: {image: elevation.pgm, min: -2, max: 4}\n", ""));
  EXPECT_EQ(site.elevation(Cell{2, 1}), 0.0);
}

TEST_F(SiteFile, ErrorsNameFileLineAndRemedy) {
  const std::string yaml = (folder_ / "site.yaml").string();
  EXPECT_THAT(error_after("image: rocks.pgm", "image: stones.pgm"),
              HasSubstr(yaml + ":1:8: image 'stones.pgm' is not"));
  EXPECT_THAT(error_after("resolution: 0.5", "resolution: [1, 2]"), HasSubstr(yaml + ":2:13: "));
  EXPECT_THAT(error_after("resolution: 0.5", "resolution: -1"),
              HasSubstr(":2:13: 'resolution' must be positive"));
  EXPECT_THAT(
      error_after("resolution: 0.5", "resolution: 0.0001"),
      HasSubstr(":2:13: 'resolution' is 0.0001 m per pixel, and must be between 0.01 and 10000; give it"));
  EXPECT_THAT(error_after("resolution: 0.5", "resolution: 1e-300"),
              HasSubstr(":2:13: 'resolution' is 1e-300"));
  EXPECT_THAT(error_after("resolution: 0.5", "resolution: 1e6"), HasSubstr(":2:13: 'resolution' is 1e+06 m"));
  EXPECT_THAT(error_after("resolution: 0.5", "resolution: .nan"),
              HasSubstr(":2:13: expected a finite number"));
  EXPECT_THAT(error_after("resolution: 0.5\n", ""), HasSubstr("'resolution' is missing"));
  EXPECT_THAT(error_after("[10, 20, 0]", "[10, 20]"), HasSubstr(":3:9: 'origin' must be [x, y, yaw]"));
  EXPECT_THAT(error_after("[10, 20, 0]", "[10, 20, 1.5]"), HasSubstr(":3:18: a rotated map"));
  EXPECT_THAT(error_after("[10, 20, 0]", "[10, .inf, 0]"), HasSubstr(":3:14: expected a finite number"));
  EXPECT_THAT(error_after("negate: 0", "negate: 7"), HasSubstr(":4:9: 'negate' must be 0 or 1"));
  EXPECT_THAT(error_after("free_thresh: 0.2", "free_thresh: 0.9"),
              HasSubstr(":6:14: thresholds must satisfy"));
  EXPECT_THAT(error_after("negate: 0", "negate: 0\nmode: raw"),
              HasSubstr(":5:7: 'mode' must be trinary or scale"));
  EXPECT_THAT(error_after("negate: 0", "negate: 0\nrocks: {max_height: 0}"),
              HasSubstr("must be positive, metres"));
  EXPECT_THAT(error_after("min: -2, max: 4", "min: 5, max: 4"), HasSubstr("'max' must not be below 'min'"));
  EXPECT_THAT(error_after("elevation:", "elevaton:"), HasSubstr(":7:1: unknown key 'elevaton'"));
  EXPECT_THAT(error_after("[10, 20, 0]", "[10, 20, 0"), HasSubstr("not valid YAML"));
}

TEST_F(SiteFile, ImagesOfAnotherSizeOrCutShortAreRefused) {
  write("elevation.pgm", to_pgm({2, 3, 65535, {0, 0, 0, 0, 0, 0}}, ""));
  EXPECT_THAT(error_after("", ""), HasSubstr("the elevation image has 2 x 3 pixels, the map 3 x 2"));
  write("elevation.pgm", to_pgm({3, 2, 65535, {0, 0, 0, 0, 0, 0}}, "").substr(0, 20));
  EXPECT_THAT(error_after("", ""), HasSubstr((folder_ / "elevation.pgm").string() + ":3: truncated"));
}

TEST_F(SiteFile, AHoleIsUnknownGroundAtTheHeightOfItsNeighbour) {
  write("elevation.pgm", to_pgm({3, 2, 65535, {0, 7, 65535, 65535, 7, 7}}, ""));
  const Site site = load_site(description("max: 4}", "max: 4, nodata: 7}"));
  EXPECT_EQ(site.occupancy(Cell{1, 1}), Occupancy::unknown);
  EXPECT_EQ(site.occupancy(Cell{2, 0}), Occupancy::unknown);
  EXPECT_EQ(site.occupancy(Cell{0, 0}), Occupancy::free);
  EXPECT_EQ(site.elevation(Cell{1, 0}), 4) << "of the cell west of it";
  EXPECT_EQ(site.elevation(Cell{2, 0}), 4) << "of the cell north of it";
  EXPECT_EQ(site.elevation(Cell{0, 1}), -2);
}

TEST_F(SiteFile, AMapOfHolesAloneIsRefused) {
  write("elevation.pgm", to_pgm({3, 2, 65535, {7, 7, 7, 7, 7, 7}}, ""));
  EXPECT_THAT(error_after("max: 4}", "max: 4, nodata: 7}"),
              AllOf(HasSubstr("site.yaml: "), HasSubstr("every cell is a hole")));
  EXPECT_THAT(error_after("max: 4}", "max: 4, nodata: -1}"), HasSubstr("must be the value of a pixel"));
}

TEST_F(SiteFile, KeepOutZonesArePolygons) {
  const Site site =
      load_site(description("negate: 0\n", "negate: 0\nkeep_out: [{polygon: [[1, 2], [3, 4], [5, 0]]}]\n"));
  ASSERT_EQ(site.keep_out().size(), 1U);
  EXPECT_EQ(site.keep_out()[0], (Polygon{{{1, 2}, {3, 4}, {5, 0}}}));
  EXPECT_THAT(error_after("negate: 0\n", "negate: 0\nkeep_out: [{polygon: [[1, 2], [3, 4]]}]\n"),
              AllOf(HasSubstr("site.yaml:5:"), HasSubstr("at least three corners")));
  EXPECT_THAT(error_after("negate: 0\n", "negate: 0\nkeep_out: [{polygn: []}]\n"), HasSubstr("'polygn'"));
}

}  // namespace
}  // namespace roci::terrain
