// The picture of a mission's ground: what a run left is read, drawn where it lies, and written as PNG.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "ground_console/cli/map/draw_map.hpp"
#include "ground_console/cli/map/png_file.hpp"

namespace roci::console::cli::map {
namespace {

using nlohmann::json;
using terrain::Point;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

terrain::Site level_site(int columns, int rows) {
  const terrain::Grid grid{columns, rows, 1.0, {0, 0}};
  terrain::SiteLayers layers;
  layers.elevation.assign(grid.cell_count(), 0.0F);
  layers.rock_height.assign(grid.cell_count(), 0.0F);
  layers.occupancy.assign(grid.cell_count(), terrain::Occupancy::free);
  return {grid, layers};
}

MissionMap level_map() { return {level_site(100, 50), "level"}; }

const char* kTrace =
    "roci-trace 1 scenario=s seed=1 lines=trace\n"
    "0 observation rover.nav idle-at(here) sampled 0\n"
    "0 observation rover.x 10 sampled 0\n"
    "0 observation rover.y 20 sampled 0\n"
    "0 plan m 1 origin 0; p1-drive [5,5] to=old x=90 y=40; 1-2 [0,-1]\n"
    "5 observation rover.x 15 sampled 5\n"
    "5 observation rover.y 22 sampled 5\n"
    "9 observation rover.x 15 sampled 9\n"
    "9 observation rover.y 22 sampled 9\n"
    "9 plan m 2 origin 9; p2-drive [5,5] to=soil x=30 y=20; p2-wait [1,1] site=soil; p3-drive [5,5] to=ridge "
    "x=60 y=25; 0-1 [0,0]\n"
    "12 observation rover.x 20 sampled 12\n"
    "13 observation rover.x north sampled 13\n";

TEST(MissionMap, TheTraceOfARunHasWayAndPlaces) {
  MissionMap map = level_map();
  std::istringstream trace(kTrace + std::string("this is no line of a trace\n"));
  add_trace(trace, map);
  ASSERT_EQ(map.driven.size(), 1U);
  EXPECT_THAT(map.driven.at("rover"), ElementsAre(Point{10, 20}, Point{15, 22}, Point{20, 22}));
  ASSERT_EQ(map.places.size(), 3U);
  EXPECT_EQ(map.places[1].name, "soil");
  EXPECT_EQ(map.places[1].at, (Point{30, 20}));
  EXPECT_THAT(map.planned_legs, ElementsAre(Way{{15, 22}, {30, 20}, {60, 25}})) << "of the newest plan";
}

TEST(MissionMap, OnePlaceHasOneMarkWithAllItsNames) {
  std::vector<NamedPlace> places;
  add_place(places, {"cliff", {1, 2}});
  add_place(places, {"cliff", {1.1, 2}});
  add_place(places, {"again", {1, 2}});
  add_place(places, {"far", {9, 2}});
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].name, "cliff, again");
}

// How far a colour is from another.
int difference(Colour a, Colour b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

// The pixel at a place of a 100 x 50 m map that is drawn 1000 pixels wide: 80 pixels of margin to the left, 86 above.
Colour pixel_at(const Picture& picture, Point p) {
  return picture.at(80 + static_cast<int>(p.x * 10), 86 + static_cast<int>((50 - p.y) * 10));
}

TEST(DrawMap, ThingsAreDrawnWhereTheyLie) {
  const Picture bare = draw_map(level_map());
  MissionMap map = level_map();
  map.driven["rover"] = {{10, 10}, {30, 10}};
  map.planned = {{{30, 10}, {60, 10}}};
  map.hazards = {{{80, 40}, 3}};
  map.keep_out = {{{{10, 30}, {30, 30}, {30, 45}, {10, 45}}}};
  map.keep_out_discs = {{{50, 35}, 5}};
  const Picture full = draw_map(map);
  EXPECT_EQ(full.width(), bare.width());
  const auto changed = [&](Point p) { return difference(pixel_at(bare, p), pixel_at(full, p)); };
  EXPECT_GT(changed({20, 10}), 150) << "driven";
  EXPECT_GT(changed({80, 40}), 60) << "hazard";
  EXPECT_GT(changed({20, 37}), 30) << "polygon";
  EXPECT_GT(changed({50, 35}), 30) << "disc";
  EXPECT_EQ(changed({50, 20}), 0);
  EXPECT_EQ(changed({80, 30}), 0);
  int dashes = 0;
  int gaps = 0;
  for (double x = 33; x < 58; x += 0.1) {
    const Colour line = pixel_at(full, {x, 10});
    (difference(line, {120, 40, 140}) < 60 ? dashes : gaps) += 1;
  }
  EXPECT_GT(dashes, 60);
  EXPECT_GT(gaps, 60) << "a plan is dashed";
}

TEST(DrawMap, ASlopeToTheNorthWestIsLitAndOneToTheSouthEastLiesInShade) {
  const terrain::Grid grid{40, 40, 1.0, {0, 0}};
  terrain::SiteLayers layers = level_site(40, 40).layers();
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const Point p = grid.centre(grid.cell_at(i));
    layers.elevation[i] = static_cast<float>(10 - 0.3 * std::hypot(p.x - 20, p.y - 20));
  }
  const Picture picture = draw_map({terrain::Site(grid, layers), "hill"}, 400);
  const auto brightness = [&](double x, double y) {
    const Colour c = picture.at(80 + static_cast<int>(x * 10), 86 + static_cast<int>((40 - y) * 10));
    return c.red + c.green + c.blue;
  };
  EXPECT_GT(brightness(13, 27), brightness(27, 13) + 100);
}

TEST(DrawMap, NoSiteAndNoPlaceIsTooStrange) {
  MissionMap thin{level_site(400, 2), "a very long and narrow site"};
  thin.places = {{"far away", {1e7, -1e7}}, {"\xc3\xa4\x01", {1, 1}}};
  thin.driven["r"] = {{-1e6, 0}, {1e6, 1}};
  thin.hazards = {{{200, 1}, 0}};
  const Picture picture = draw_map(thin);
  EXPECT_LT(picture.width(), 1600);
  EXPECT_LT(picture.height(), 1600);
  EXPECT_GT(draw_map({level_site(1, 1), ""}).width(), 300);
}

class MapFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs `roci map` and returns its exit code; what it prints stands in out and err.
  int map(const std::string& arguments) {
    const std::string command = "'" ROCI_BINARY_DIR "/bin/roci' map " + arguments + " > '" +
                                (folder_ / "out").string() + "' 2> '" + (folder_ / "err").string() + "'";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string text(const std::string& name) {
    std::ostringstream out;
    out << std::ifstream(folder_ / name).rdbuf();
    return out.str();
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("roci_map_" + std::to_string(::getpid()) + "_" +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(MapFile, APngHoldsThePicture) {
  Picture picture(3, 2, {1, 2, 3});
  picture.mix(2, 1, {200, 100, 50}, 1);
  write_png(picture, folder_ / "p.png");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, (folder_ / "p.png").c_str()), 0);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(bytes, picture.bytes());
  EXPECT_EQ(bytes[15], 200);
  EXPECT_THROW(write_png(picture, folder_ / "no" / "p.png"), std::runtime_error);
}

TEST_F(MapFile, TheProgramDrawsAMissionAndARun) {
  const std::string mission = "--mission '" ROCI_SOURCE_DIR "/missions/planetary'";
  const std::string png = (folder_ / "m.png").string();
  ASSERT_EQ(map("--png '" + png + "' " + mission), 0) << text("err");
  EXPECT_THAT(text("out"), HasSubstr("m.png: "));
  EXPECT_EQ(text("m.png").substr(1, 3), "PNG");

  std::ofstream(folder_ / "run.txt") << kTrace;
  ASSERT_EQ(map("--json --png '" + png + "' " + mission + " --run '" + (folder_ / "run.txt").string() + "'"),
            0)
      << text("err");
  const json told = json::parse(text("out"));
  EXPECT_EQ(told["driven"]["rover"], 3);
  EXPECT_EQ(told["places"], 3);

  EXPECT_EQ(map("--png '" + png + "' --mission nowhere"), 2);
  EXPECT_THAT(text("err"), HasSubstr("nowhere"));
  EXPECT_EQ(map("--png '" + png + "' --run '" + folder_.string() + "'"), 2);
  EXPECT_THAT(text("err"), HasSubstr("is no run folder that names its mission; see roci runs"));
  EXPECT_EQ(map("--png '" + (folder_ / "no/m.png").string() + "' " + mission), 1);
  EXPECT_THAT(text("err"), HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace roci::console::cli::map
