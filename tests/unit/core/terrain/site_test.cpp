#include "core/terrain/site.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {
namespace {

// A tilted plane z = 1 + 0.2 x - 0.1 y with one rock of 0.4 m in cell (3, 2).
Site tilted_plane() {
  const Grid grid{12, 9, 0.5, {-2, 3}};
  SiteLayers layers;
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const Point p = grid.centre(grid.cell_at(i));
    layers.elevation.push_back(static_cast<float>(1 + 0.2 * p.x - 0.1 * p.y));
  }
  layers.rock_height.assign(grid.cell_count(), 0);
  layers.occupancy.assign(grid.cell_count(), Occupancy::free);
  layers.rock_height[grid.index({3, 2})] = 0.4F;
  layers.occupancy[grid.index({3, 2})] = Occupancy::occupied;
  return Site(grid, layers);
}

TEST(Grid, CellsAndPointsAgree) {
  std::mt19937_64 random(3);
  for (const double resolution : {0.1, 0.25, 0.3, 1.0, 7.5}) {
    const Grid grid{33, 21, resolution, {-4.7, 11.1}};
    for (int k = 0; k < 2000; ++k) {
      const Cell c{static_cast<int>(random() % 33), static_cast<int>(random() % 21)};
      EXPECT_EQ(grid.cell_of(grid.centre(c)), c);
      EXPECT_EQ(grid.cell_at(grid.index(c)), c);
      const Point p{grid.origin.x + (static_cast<double>(random() % 1200) / 1000 - 0.1) * grid.width(),
                    grid.origin.y + (static_cast<double>(random() % 1200) / 1000 - 0.1) * grid.height()};
      EXPECT_EQ(grid.contains(p), grid.contains(grid.cell_of(p)));
    }
    const Point east_end{std::nextafter(grid.origin.x + grid.width(), 0), grid.origin.y};
    EXPECT_TRUE(!grid.contains(east_end) || grid.contains(grid.cell_of(east_end)));
  }
}

TEST(Grid, PointsThatAreNoNumbersLieOutside) {
  const Grid grid{3, 3, 1, {0, 0}};
  EXPECT_FALSE(grid.contains(Point{std::numeric_limits<double>::quiet_NaN(), 1}));
  EXPECT_FALSE(grid.contains(Point{1, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(grid.contains(Point{1e300, 1}));
}

TEST(Site, BilinearElevationIsExactOnAPlane) {
  const Site site = tilted_plane();
  std::mt19937_64 random(4);
  for (int k = 0; k < 500; ++k) {
    const Point p{-1.7 + 5.4 * static_cast<double>(random() % 1000) / 1000,
                  3.3 + 3.9 * static_cast<double>(random() % 1000) / 1000};
    EXPECT_NEAR(site.elevation(p), 1 + 0.2 * p.x - 0.1 * p.y, 1e-5);
    EXPECT_NEAR(site.slope(p), std::atan(std::hypot(0.2, 0.1)), 1e-5);
    EXPECT_NEAR(site.gradient(p).east, 0.2, 1e-5);
    EXPECT_NEAR(site.gradient(p).north, -0.1, 1e-5);
  }
}

TEST(Site, ElevationIsClampedOutside) {
  const Site site = tilted_plane();
  EXPECT_DOUBLE_EQ(site.elevation(Point{-100, -100}), site.elevation(Cell{0, 0}));
  EXPECT_DOUBLE_EQ(site.elevation(Point{100, 100}), site.elevation(Cell{11, 8}));
}

TEST(Site, RocksAreFoundInTheirCell) {
  const Site site = tilted_plane();
  const Point rock = site.grid().centre({3, 2});
  EXPECT_FLOAT_EQ(static_cast<float>(site.rock_height(rock)), 0.4F);
  EXPECT_EQ(site.occupancy(rock), Occupancy::occupied);
  EXPECT_EQ(site.rock_height(Point{rock.x + 0.5, rock.y}), 0);
  EXPECT_EQ(site.occupancy(Point{rock.x + 0.5, rock.y}), Occupancy::free);
  EXPECT_EQ(site.occupancy(Point{99, 99}), Occupancy::unknown);
}

TEST(Site, RefusesHolesAndWrongSizes) {
  const Grid grid{2, 2, 1, {0, 0}};
  const SiteLayers good{std::vector<float>(4), std::vector<float>(4), std::vector<Occupancy>(4)};
  EXPECT_NO_THROW(Site(grid, good));
  SiteLayers hole = good;
  hole.elevation[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Site(grid, hole), MapError);
  SiteLayers short_layer = good;
  short_layer.rock_height.pop_back();
  EXPECT_THROW(Site(grid, short_layer), MapError);
  SiteLayers short_occupancy = good;
  short_occupancy.occupancy.pop_back();
  EXPECT_THROW(Site(grid, short_occupancy), MapError);
  EXPECT_THROW(Site(Grid{2, 2, 0, {0, 0}}, good), MapError);
  EXPECT_THROW(Site(Grid{0, 2, 1, {0, 0}}, SiteLayers{}), MapError);
}

}  // namespace
}  // namespace roci::terrain
