// GeoTIFFs are made here, with GDAL.
#include "core/terrain/geotiff.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"

namespace roci::terrain {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Is a map of 4 x 3 pixels of 2 m in UTM zone 33, whose elevations count from the north-west;
// each test spoils one thing.
struct Recipe {
  int columns = 4;
  int rows = 3;
  int bands = 1;
  int epsg = 32633;  // 0: none
  std::array<double, 6> transform{500000, 2, 0, 5000006, 0, -2};
  bool has_transform = true;
  std::vector<float> pixels{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  double hole = -9999;
};

class Geotiff : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path make(const Recipe& recipe) {
    GDALRegister_GTiff();
    const std::filesystem::path file = folder_ / "dem.tif";
    GDALDataset* out = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), recipe.columns, recipe.rows, recipe.bands, GDT_Float32, nullptr);
    auto transform = recipe.transform;
    if (recipe.has_transform) out->SetGeoTransform(transform.data());
    if (recipe.epsg != 0) {
      OGRSpatialReference frame;
      frame.importFromEPSG(recipe.epsg);
      out->SetSpatialRef(&frame);
    }
    std::vector<float> pixels = recipe.pixels;
    for (int band = 1; band <= recipe.bands; ++band) {
      out->GetRasterBand(band)->SetNoDataValue(recipe.hole);
      EXPECT_EQ(out->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, recipe.columns, recipe.rows, pixels.data(),
                                                   recipe.columns, recipe.rows, GDT_Float32, 0, 0),
                CE_None);
    }
    GDALClose(out);
    return file;
  }

  static std::string error_of(const std::filesystem::path& file) {
    try {
      load_site(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("roci_geotiff_" + std::to_string(::getpid()) + "_" +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Geotiff, IsASiteByItself) {
  const Site site = load_site(make({}));
  EXPECT_EQ(site.grid(), (Grid{4, 3, 2, {500000, 5000000}}));
  EXPECT_EQ(site.elevation(Cell{0, 2}), 0) << "north-west";
  EXPECT_EQ(site.elevation(Cell{3, 0}), 11) << "south-east";
  EXPECT_EQ(site.elevation(Point{500007, 5000001}), 11);
  EXPECT_EQ(site.occupancy(Cell{1, 1}), Occupancy::free);
}

TEST_F(Geotiff, GivesADescriptionItsElevation) {
  make({});
  std::ofstream(folder_ / "site.yaml")
      << "elevation: {image: dem.tif}\norigin: [0, 0, 0]\nkeep_out: [{polygon: [[0, 0], [1, 0], [0, 1]]}]\n";
  const Site site = load_site(folder_ / "site.yaml");
  EXPECT_EQ(site.grid(), (Grid{4, 3, 2, {0, 0}}));
  EXPECT_EQ(site.elevation(Cell{3, 0}), 11);
  EXPECT_EQ(site.keep_out().size(), 1U);

  std::string rocks = "P2\n4 3\n255\n0 255 255 255 255 255 255 255 255 255 255 255\n";
  std::ofstream(folder_ / "rocks.pgm") << rocks;
  const std::string with_rocks =
      "image: rocks.pgm\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
      "elevation: {image: dem.tif}\n";
  std::ofstream(folder_ / "rocks.yaml") << with_rocks << "resolution: 2\n";
  EXPECT_EQ(load_site(folder_ / "rocks.yaml").occupancy(Cell{0, 2}), Occupancy::occupied);
  EXPECT_EQ(load_site(folder_ / "rocks.yaml").elevation(Cell{3, 0}), 11);
  std::ofstream(folder_ / "rocks.yaml") << with_rocks << "resolution: 1\n";
  EXPECT_THAT(error_of(folder_ / "rocks.yaml"), HasSubstr("the GeoTIFF has pixels of 2.0"));
}

TEST_F(Geotiff, HolesAreUnknownGround) {
  Recipe recipe;
  recipe.pixels[1] = -9999;
  recipe.pixels[6] = std::nanf("");
  const Site site = load_site(make(recipe));
  EXPECT_EQ(site.occupancy(Cell{1, 2}), Occupancy::unknown);
  EXPECT_EQ(site.occupancy(Cell{2, 1}), Occupancy::unknown);
  EXPECT_EQ(site.occupancy(Cell{0, 2}), Occupancy::free);
  EXPECT_GE(site.elevation(Cell{1, 2}), 0) << "of a neighbour";
  recipe.pixels.assign(12, -9999);
  EXPECT_THAT(error_of(make(recipe)), AllOf(HasSubstr("dem.tif: "), HasSubstr("every cell is a hole")));
}

TEST_F(Geotiff, WhatIsNoMapInMetresIsRefusedWithTheRemedy) {
  const auto refused = [this](auto spoil) {
    Recipe recipe;
    spoil(recipe);
    return error_of(make(recipe));
  };
  EXPECT_THAT(refused([](Recipe& r) { r.epsg = 0; }),
              AllOf(HasSubstr("dem.tif: has no projection"), HasSubstr("gdal_edit.py -a_srs")));
  EXPECT_THAT(refused([](Recipe& r) { r.epsg = 4326; }),
              AllOf(HasSubstr("is in degrees"), HasSubstr("gdalwarp")));
  EXPECT_THAT(refused([](Recipe& r) { r.epsg = 2263; }), HasSubstr("is not in metres"));
  EXPECT_THAT(refused([](Recipe& r) { r.transform[5] = -3; }), HasSubstr("square ones are needed"));
  EXPECT_THAT(refused([](Recipe& r) { r.transform[2] = 0.5; }), HasSubstr("is rotated"));
  EXPECT_THAT(refused([](Recipe& r) { r.transform[5] = 2; }), HasSubstr("south at the top"));
  EXPECT_THAT(refused([](Recipe& r) { r.has_transform = false; }),
              HasSubstr("does not say where its pixels lie"));
  EXPECT_THAT(refused([](Recipe& r) { r.bands = 3; }),
              AllOf(HasSubstr("has 3 bands"), HasSubstr("gdal_translate -b")));
}

TEST_F(Geotiff, BrokenAndAbsentFilesAreNamed) {
  const std::filesystem::path file = make({});
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 30);
  EXPECT_THAT(error_of(file), AllOf(HasSubstr("dem.tif: is"), HasSubstr("GDAL: ")));
  std::ofstream(file) << "no image";
  EXPECT_THAT(error_of(file), HasSubstr("dem.tif: is not a GeoTIFF that can be read"));
  std::filesystem::remove(file);
  EXPECT_THAT(error_of(file), HasSubstr("dem.tif: cannot open the GeoTIFF"));
}

}  // namespace
}  // namespace roci::terrain
