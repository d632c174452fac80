#include "pathplan_svc/costmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

double distance_to_square(terrain::Point p, terrain::Point centre, double side) {
  return std::hypot(std::max(std::abs(p.x - centre.x) - side / 2, 0.0),
                    std::max(std::abs(p.y - centre.y) - side / 2, 0.0));
}

TEST(Costmap, EachPointOfAFreeCellKeepsTheRoversRadius) {
  for (const double radius : {0.4, 0.8, 1.7}) {
    std::mt19937_64 random(11);
    const terrain::Site site = random_site(5, 40, 60);
    RoverLimits limits;
    limits.radius = radius;
    Costmap map(site, limits);
    const std::vector<Disc> discs{{{12.3, 20.9}, 2.2}, {{30, 8}, 0}};
    map.set_discs(discs);
    int free = 0;
    for (int k = 0; k < 4000; ++k) {
      const terrain::Point p{uniform(random, 0, 40), uniform(random, 0, 40)};
      if (!map.is_free(p)) continue;
      ++free;
      EXPECT_GE(std::min({p.x, p.y, 40 - p.x, 40 - p.y}), radius);
      for (const Disc& disc : discs)
        EXPECT_GE(terrain::distance(p, disc.centre), disc.radius + radius - 1e-12);
      for (std::size_t i = 0; i < map.grid().cell_count(); ++i) {
        const terrain::Cell c = map.grid().cell_at(i);
        if (site.rock_height(c) <= limits.rock_clearance) continue;
        ASSERT_GE(distance_to_square(p, map.grid().centre(c), 1.0), radius);
      }
    }
    EXPECT_GT(free, 400);
  }
}

TEST(Costmap, CellsFarFromEverythingAreFree) {
  const terrain::Site site = made_site(20, 1.0, level, [](terrain::Point p) {
    return p.x > 10 && p.x < 11 && p.y > 10 && p.y < 11 ? 0.5 : 0.0;
  });
  const Costmap map(site, {});
  int blocked = 0;
  for (int row = 1; row < 19; ++row) {
    for (int column = 1; column < 19; ++column) blocked += map.is_free(terrain::Cell{column, row}) ? 0 : 1;
  }
  EXPECT_EQ(blocked, 9);
  EXPECT_EQ(map.state(terrain::Cell{10, 10}), CellState::rock);
  EXPECT_EQ(map.state(terrain::Cell{11, 9}), CellState::margin);
}

TEST(Costmap, GradientAndSlopeLimitOnAPlane) {
  for (const double grade : {0.2, 0.36, 0.37, 0.6}) {
    const terrain::Site site = made_site(
        12, 0.5, [&](terrain::Point p) { return grade * p.y; }, no_rocks);
    const Costmap map(site, {});
    const terrain::Cell middle{6, 6};
    EXPECT_NEAR(map.gradient(map.grid().index(middle)).north, grade, 1e-5);
    EXPECT_NEAR(map.gradient(map.grid().index(middle)).east, 0, 1e-5);
    EXPECT_NEAR(map.roughness(map.grid().index(middle)), 0, 1e-5);
    EXPECT_EQ(map.state(middle), std::atan(grade) > 0.35 ? CellState::steep : CellState::free) << grade;
  }
}

TEST(Costmap, AStepInTheGroundIsRough) {
  const terrain::Site site = made_site(
      12, 1.0, [](terrain::Point p) { return p.x > 5 && p.x < 6 && p.y > 5 && p.y < 6 ? 0.6 : 0; }, no_rocks);
  const Costmap map(site, {});
  EXPECT_EQ(map.state(terrain::Cell{5, 5}), CellState::rough);
  EXPECT_TRUE(map.is_free(terrain::Cell{8, 8}));
}

TEST(Costmap, RocksBelowTheClearanceOnlyRoughen) {
  const Costmap map(made_site(9, 1.0, level, [](terrain::Point) { return 0.2; }), {});
  EXPECT_TRUE(map.is_free(terrain::Cell{4, 4}));
  EXPECT_NEAR(map.roughness(map.grid().index({4, 4})), 0.8, 1e-6);
}

TEST(Costmap, UnknownGroundIsBlocked) {
  const terrain::Grid grid{5, 5, 1, {0, 0}};
  terrain::SiteLayers layers{std::vector<float>(25), std::vector<float>(25),
                             std::vector<terrain::Occupancy>(25, terrain::Occupancy::free)};
  layers.occupancy[12] = terrain::Occupancy::unknown;
  EXPECT_EQ(Costmap(terrain::Site(grid, layers), {}).state(12), CellState::unknown);
}

TEST(Costmap, TheVersionCountsChanges) {
  Costmap map(made_site(20, 1.0, level, no_rocks), {});
  EXPECT_EQ(map.version(), 1U);
  EXPECT_FALSE(map.set_discs({}));
  EXPECT_TRUE(map.set_discs({{{10, 10}, 2}}));
  EXPECT_EQ(map.version(), 2U);
  EXPECT_FALSE(map.set_discs({{{10, 10}, 2}, {{10, 10}, 0.5}})) << "a disc within another changes nothing";
  EXPECT_FALSE(map.set_discs({{{10, 10}, 2}, {{500, 500}, 3}})) << "nor does one off the map";
  EXPECT_EQ(map.version(), 2U);
  EXPECT_EQ(map.state(terrain::Cell{10, 10}), CellState::disc);
  EXPECT_TRUE(map.set_discs({}));
  EXPECT_EQ(map.version(), 3U);
  EXPECT_TRUE(map.is_free(terrain::Cell{10, 10}));
}

TEST(Costmap, RefusesDiscsAndLimitsThatMakeNoSense) {
  const terrain::Site site = made_site(9, 1.0, level, no_rocks);
  Costmap map(site, {});
  map.set_discs({{{4.5, 4.5}, 0.5}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.set_discs({{{nan, 4}, 1}}), std::invalid_argument);
  EXPECT_THROW(map.set_discs({{{4, 4}, nan}}), std::invalid_argument);
  EXPECT_THROW(map.set_discs({{{4, 4}, -1}}), std::invalid_argument);
  EXPECT_EQ(map.state(terrain::Cell{4, 4}), CellState::disc);
  RoverLimits limits;
  limits.radius = 0;
  EXPECT_THROW(Costmap(site, limits), std::invalid_argument);
  limits = {};
  limits.radius = 100.5;
  EXPECT_THROW(Costmap(site, limits), std::invalid_argument);
}

TEST(Costmap, ASlopeHasNoStepAndALedgeHas) {
  // A ledge of 0.3 m at x = 20, which the fitted plane takes for a gentle slope, and a ramp of 0.15 m a cell behind it.
  const terrain::Site site = made_site(
      40, 1.0, [](terrain::Point p) { return (p.x > 20 ? 0.3 : 0.0) + 0.15 * std::max(0.0, p.x - 30); },
      no_rocks);
  RoverLimits limits;
  const Costmap without(site, limits);
  limits.max_step = 0.2;
  const Costmap with(site, limits);
  for (std::size_t i = 0; i < without.grid().cell_count(); ++i) EXPECT_NE(without.state(i), CellState::step);
  EXPECT_EQ(without.state(terrain::Cell{20, 15}), CellState::free);
  for (int column = 5; column < 35; ++column) {
    const bool at_ledge = column == 19 || column == 20;
    EXPECT_EQ(with.state(terrain::Cell{column, 15}), at_ledge ? CellState::step : CellState::free) << column;
  }
}

TEST(Costmap, KeepOutPolygonsKeepTheRoversRadiusAway) {
  // A figure with a bay, one zone of the site and one of the mission.
  const terrain::Polygon bay{{{10, 10}, {30, 12}, {18, 18}, {28, 30}, {9, 27}}};
  const terrain::Polygon corner{{{36, 36}, {60, 36}, {60, 60}, {36, 60}}};
  terrain::SiteLayers layers = made_site(40, 1.0, level, no_rocks).layers();
  layers.keep_out = {bay};
  const Costmap map(terrain::Site({40, 40, 1.0, {0, 0}}, layers), {}, {corner});
  EXPECT_EQ(map.state(terrain::Cell{12, 12}), CellState::keep_out);
  EXPECT_EQ(map.state(terrain::Cell{37, 37}), CellState::keep_out);
  EXPECT_EQ(map.state(terrain::Cell{27, 21}), CellState::free) << "in the bay";
  std::mt19937_64 random(8);
  for (int k = 0; k < 20000; ++k) {
    const terrain::Point p{uniform(random, 0, 40), uniform(random, 0, 40)};
    if (!map.is_free(p)) continue;
    for (const terrain::Polygon& zone : {bay, corner}) {
      ASSERT_FALSE(terrain::contains(zone, p));
      ASSERT_GE(terrain::distance_to_outline(zone, p), map.limits().radius - 1e-9);
    }
  }
}

}  // namespace
}  // namespace roci::pathplan
