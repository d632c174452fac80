#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/terrain/geotiff.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"

namespace roci::terrain {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string error_of(const std::filesystem::path& site) {
  try {
    load_site(site);
  } catch (const MapError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GeotiffWithoutGdal, IsRefusedWithTheWayToHaveIt) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("roci_no_gdal_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "dem.tif") << "II*";
  std::ofstream(folder / "site.yaml") << "elevation: {image: dem.tif}\n";
  const auto says_how = AllOf(HasSubstr("dem.tif: this program was built without GDAL"),
                              HasSubstr("libgdal-dev"), HasSubstr("-DROCI_GEOTIFF=ON"));
  EXPECT_THAT(error_of(folder / "dem.tif"), says_how);
  EXPECT_THAT(error_of(folder / "site.yaml"), says_how);
  std::filesystem::remove_all(folder);
}

TEST(GeotiffWithoutGdal, NamesAreKnownInAnyCase) {
  EXPECT_TRUE(is_geotiff_name("a/b.TIF"));
  EXPECT_TRUE(is_geotiff_name("b.tiff"));
  EXPECT_FALSE(is_geotiff_name("site.yaml"));
  EXPECT_FALSE(is_geotiff_name("tif"));
}

}  // namespace
}  // namespace roci::terrain
