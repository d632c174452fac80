#include "pathplan_svc/path_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/terrain/site_file.hpp"
#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

using terrain::Point;

const terrain::Site& planetary_site() {
  static const terrain::Site site =
      terrain::load_site(std::string(ROCI_SOURCE_DIR) + "/missions/planetary/site/site.yaml");
  return site;
}

PathPlanner planetary() { return PathPlanner(planetary_site(), {}, {}); }

std::vector<std::pair<Point, Point>> random_queries(const Costmap& map, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto place = [&] {
    while (true) {
      const Point p{uniform(random, 0, map.grid().width()), uniform(random, 0, map.grid().height())};
      if (map.is_free(p)) return p;
    }
  };
  std::vector<std::pair<Point, Point>> queries;
  for (int k = 0; k < count; ++k) {
    const Point from = place();
    queries.emplace_back(from, place());
  }
  return queries;
}

// Distance to the nearest rock that the rover cannot pass over, by looking at every cell around.
double clearance(const terrain::Site& site, const RoverLimits& limits, Point p) {
  double nearest = std::numeric_limits<double>::infinity();
  const terrain::Cell here = site.grid().cell_of(p);
  for (int dy = -4; dy <= 4; ++dy) {
    for (int dx = -4; dx <= 4; ++dx) {
      const terrain::Cell c{here.column + dx, here.row + dy};
      if (!site.grid().contains(c) || site.rock_height(c) <= limits.rock_clearance) continue;
      const Point centre = site.grid().centre(c);
      const double half = site.grid().resolution / 2;
      nearest = std::min(nearest, std::hypot(std::max(std::abs(p.x - centre.x) - half, 0.0),
                                             std::max(std::abs(p.y - centre.y) - half, 0.0)));
    }
  }
  return nearest;
}

TEST(PathPlanner, PathsAreSafeAtFineSampling) {
  PathPlanner planner = planetary();
  const RoverLimits limits = planner.map().limits();
  const double steepest = std::tan(limits.max_slope);
  for (const auto& [from, to] : random_queries(planner.map(), 30, 71)) {
    const PathOutcome outcome = planner.path(from, to);
    if (outcome.status != PathStatus::found) continue;
    EXPECT_EQ(outcome.waypoints.front(), from);
    EXPECT_EQ(outcome.waypoints.back(), to);
    for (std::size_t i = 1; i < outcome.waypoints.size(); ++i) {
      EXPECT_LE(terrain::distance(outcome.waypoints[i - 1], outcome.waypoints[i]), 4.0);
    }
    for (const Point p : densify(outcome.waypoints, 0.05)) {
      ASSERT_GE(clearance(planetary_site(), limits, p), limits.radius - 1e-9);
      const terrain::Gradient g =
          planner.map().gradient(planner.map().grid().index(planner.map().grid().cell_of(p)));
      ASSERT_LE(std::hypot(g.east, g.north), steepest * (1 + 1e-5));
    }
  }
}

TEST(PathPlanner, IsNeverSlowerThanTheExactGridNorFasterThanThePossible) {
  PathPlanner planner = planetary();
  const GridSearch search(planner.map(), planner.drive());
  double planned = 0;
  double over_grid = 0;
  for (const auto& [from, to] : random_queries(planner.map(), 40, 72)) {
    const PathOutcome outcome = planner.path(from, to);
    const terrain::Grid& grid = planner.map().grid();
    Polyline exact = search.from(planner.map(), grid.cell_of(from)).path_to(grid.cell_of(to));
    ASSERT_EQ(outcome.status == PathStatus::found, !exact.empty());
    if (exact.size() < 2) continue;
    exact.front() = from;
    exact.back() = to;
    const double bound = measure(planner.map(), planner.drive(), exact).time;
    EXPECT_LE(outcome.time, bound + 1e-9);
    EXPECT_GE(outcome.time, terrain::distance(from, to) * planner.drive().fastest());
    EXPECT_GE(outcome.length, terrain::distance(from, to) - 1e-9);
    EXPECT_NEAR(outcome.time, measure(planner.map(), planner.drive(), outcome.waypoints).time,
                1e-6 * outcome.time);
    EXPECT_NEAR(outcome.energy, measure(planner.map(), planner.drive(), outcome.waypoints).energy,
                1e-6 * outcome.energy);
    planned += outcome.time;
    over_grid += bound;
  }
  EXPECT_LT(planned, 0.9 * over_grid) << "any-angle paths save at least the grid's zigzag";
}

TEST(PathPlanner, OnLevelGroundThePathIsStraight) {
  PathPlanner planner(made_site(60, 1.0, level, no_rocks), {}, {});
  for (const auto& [from, to] : random_queries(planner.map(), 20, 73)) {
    EXPECT_NEAR(planner.path(from, to).length, terrain::distance(from, to),
                1e-3 * terrain::distance(from, to));
  }
}

TEST(PathPlanner, AnswersDoNotDependOnEarlierQuestions) {
  PathPlanner one = planetary();
  PathPlanner other = planetary();
  auto queries = random_queries(one.map(), 12, 74);
  std::vector<PathOutcome> forwards;
  for (const auto& [from, to] : queries) forwards.push_back(one.path(from, to));
  other.set_discs({{{100, 100}, 5}});
  other.path({40, 40}, {150, 120});
  other.set_discs({});
  for (std::size_t i = queries.size(); i-- > 0;) {
    const PathOutcome again = other.path(queries[i].first, queries[i].second);
    EXPECT_EQ(again.status, forwards[i].status);
    EXPECT_EQ(again.waypoints, forwards[i].waypoints);
    EXPECT_EQ(again.time, forwards[i].time);
    EXPECT_EQ(again.energy, forwards[i].energy);
    EXPECT_EQ(other.path(queries[i].first, queries[i].second).waypoints, forwards[i].waypoints)
        << "from the cache";
  }
}

TEST(PathPlanner, TheSitesPlacesAreAsItsReadmeSays) {
  PathPlanner planner = planetary();
  const std::vector<Point> open{{40, 40},   {110, 60},  {150, 120}, {70, 140}, {200, 200},
                                {120, 160}, {136, 152}, {215, 95},  {100, 25}, {20, 120}};
  for (const Point from : open) {
    for (const Point to : open) EXPECT_EQ(planner.path(from, to).status, PathStatus::found);
  }
  for (const Point closed : {Point{190, 60}, Point{50, 180}}) {
    EXPECT_EQ(planner.path({40, 40}, closed).status, PathStatus::unreachable);
    EXPECT_EQ(planner.path(closed, {40, 40}).status, PathStatus::unreachable);
    EXPECT_EQ(planner.path(closed, {closed.x + 1.5, closed.y}).status, PathStatus::found);
  }
  for (const Point tight : {Point{60, 220}, Point{175, 180}}) {
    const PathOutcome outcome = planner.path({40, 40}, tight);
    EXPECT_EQ(outcome.status, PathStatus::goal_blocked);
    EXPECT_EQ(outcome.blocked_by, CellState::margin);
    EXPECT_EQ(planner.path(tight, {40, 40}).status, PathStatus::found) << "a margin may be left";
  }
}

TEST(PathPlanner, AnObstacleOnTheWayChangesTheAnswer) {
  PathPlanner planner = planetary();
  const PathOutcome before = planner.path({40, 40}, {150, 120});
  const Point on_path = before.waypoints[before.waypoints.size() / 2];
  ASSERT_TRUE(planner.set_discs({{on_path, 3}}));
  const PathOutcome after = planner.path({40, 40}, {150, 120});
  ASSERT_EQ(after.status, PathStatus::found);
  EXPECT_GT(after.time, before.time);
  for (const Point p : densify(after.waypoints, 0.05)) EXPECT_GE(terrain::distance(p, on_path), 3.8 - 1e-9);
  planner.set_discs({});
  EXPECT_EQ(planner.path({40, 40}, {150, 120}).waypoints, before.waypoints);
}

TEST(PathPlanner, AWallOfObstaclesIsProvedToSeparate) {
  PathPlanner planner(made_site(40, 1.0, level, no_rocks), {}, {});
  EXPECT_EQ(planner.path({5, 20}, {35, 20}).status, PathStatus::found);
  std::vector<Disc> wall;
  for (double y = 0; y <= 40; y += 2) wall.push_back({{20, y}, 1});
  planner.set_discs(wall);
  EXPECT_EQ(planner.path({5, 20}, {35, 20}).status, PathStatus::unreachable);
  EXPECT_EQ(planner.path({5, 20}, {20, 20}).status, PathStatus::goal_blocked);
  EXPECT_EQ(planner.path({5, 20}, {20, 20}).blocked_by, CellState::disc);
}

TEST(PathPlanner, AnObstacleBesideTheRoverIsLeftBehindInside) {
  PathPlanner planner(made_site(40, 1.0, level, no_rocks), {}, {});
  planner.set_discs({{{20, 20}, 2}});
  const Point beside{22.4, 20};
  ASSERT_EQ(planner.map().state(planner.map().grid().cell_of(beside)), CellState::margin);
  const PathOutcome away = planner.path(beside, {35, 20});
  EXPECT_EQ(away.status, PathStatus::found);
  EXPECT_EQ(away.waypoints.front(), beside);
  EXPECT_EQ(planner.path(beside, beside).time, 0);
  const PathOutcome within = planner.path({20, 20}, {35, 20});
  EXPECT_EQ(within.status, PathStatus::start_blocked);
  EXPECT_EQ(within.blocked_by, CellState::disc);
}

TEST(PathPlanner, EndsOffTheMapAreNamed) {
  PathPlanner planner = planetary();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(planner.path({40, 40}, {240, 40}).status, PathStatus::goal_outside);
  EXPECT_EQ(planner.path({-1, 40}, {40, 40}).status, PathStatus::start_outside);
  EXPECT_EQ(planner.path({40, 40}, {nan, 40}).status, PathStatus::goal_outside);
  EXPECT_EQ(planner.path({40, std::numeric_limits<double>::infinity()}, {40, 40}).status,
            PathStatus::start_outside);
}

TEST(PathPlanner, StandingStillCostsNothing) {
  PathPlanner planner = planetary();
  const PathOutcome outcome = planner.path({40, 40}, {40, 40});
  EXPECT_EQ(outcome.status, PathStatus::found);
  EXPECT_EQ(outcome.time, 0);
  EXPECT_EQ(outcome.energy, 0);
  EXPECT_EQ(outcome.waypoints.size(), 1U);
}

}  // namespace
}  // namespace roci::pathplan
