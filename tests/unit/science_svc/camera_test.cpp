#include "science_svc/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace roci::science {
namespace {

constexpr CameraModel kLevel{2, 0, 90};  // of an image 100 x 100: focal length 50 pixels

TEST(Camera, APixelOfFlatGroundLiesWhereTrigonometrySays) {
  // 10 pixels below the horizon: 2 m * 50 / 10 ahead; 5 to the right: 10 m * 5 / 50 aside.
  const auto p = ground_at({}, kLevel, {{100, 50}, 0}, 100, 100, 55, 60, 50);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 110, 1e-6);
  EXPECT_NEAR(p->y, 49, 1e-6);
  const auto north = ground_at({}, kLevel, {{100, 50}, std::numbers::pi / 2}, 100, 100, 55, 60, 50);
  ASSERT_TRUE(north);
  EXPECT_NEAR(north->x, 101, 1e-6);
  EXPECT_NEAR(north->y, 60, 1e-6);
}

TEST(Camera, TheMiddleOfATiltedImageLiesWhereItsAxisMeetsTheGround) {
  const CameraModel tilted{1.9, 18, 60};
  const auto p = ground_at({}, tilted, {{0, 0}, 0}, 96, 64, 48, 32, 50);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 1.9 / std::tan(18 * std::numbers::pi / 180), 1e-6);
}

TEST(Camera, SkyFarGroundAndWhatIsOffTheMapAreNoPlaces) {
  EXPECT_FALSE(ground_at({}, kLevel, {{0, 0}, 0}, 100, 100, 50, 49, 1000));
  EXPECT_FALSE(ground_at({}, kLevel, {{0, 0}, 0}, 100, 100, 50, 60, 9.9));
  const terrain::Grid grid{8, 8, 1.0, {0, 0}};
  terrain::SiteLayers layers;
  layers.elevation.assign(64, 0);
  layers.rock_height.assign(64, 0);
  layers.occupancy.assign(64, terrain::Occupancy::free);
  const terrain::Site site(grid, layers);
  EXPECT_FALSE(ground_at({&site}, kLevel, {{4, 4}, 0}, 100, 100, 50, 60, 50));
  EXPECT_TRUE(ground_at({&site}, kLevel, {{4, 4}, 0}, 100, 100, 50, 90, 50));
}

TEST(Camera, ARiseIsMetEarlierThanFlatGround) {
  const terrain::Grid grid{100, 100, 1.0, {0, 0}};
  terrain::SiteLayers layers;
  layers.rock_height.assign(grid.cell_count(), 0);
  layers.occupancy.assign(grid.cell_count(), terrain::Occupancy::free);
  for (std::size_t i = 0; i < grid.cell_count(); ++i)
    layers.elevation.push_back(static_cast<float>(0.1 * grid.centre(grid.cell_at(i)).x));
  const terrain::Site site(grid, layers);
  // The ray falls 0.2 m a metre and the ground rises 0.1.
  const auto p = ground_at({&site}, kLevel, {{50, 50}, 0}, 100, 100, 50, 60, 50);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 50 + 2 / 0.3, 1e-3);
}

}  // namespace
}  // namespace roci::science
