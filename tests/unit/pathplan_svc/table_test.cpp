// The table of costs between places: lower bounds, what is proved, what stays after a change of the map.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "pathplan_svc/path_planner.hpp"
#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

using terrain::Cell;
using terrain::Point;

Point random_point(std::mt19937_64& random, const terrain::Grid& grid) {
  return {uniform(random, 0, grid.width()), uniform(random, 0, grid.height())};
}

DriveModel random_drive(std::mt19937_64& random) {
  DriveModel drive;
  drive.speed = uniform(random, 0.02, 1);
  drive.slip_per_grade = uniform(random, 0, 2);
  drive.rough_slowdown = uniform(random, 0, 0.9);
  drive.turn_rate = uniform(random, 0.02, 1);
  drive.rolling_resistance = uniform(random, 0, 0.6);
  drive.drive_efficiency = uniform(random, 0.1, 1);
  drive.idle_power = uniform(random, 0, 100);
  drive.turn_power = uniform(random, 0, 100);
  return drive;
}

// Tells whether two answers are the same to the last bit.
void expect_same(const PathOutcome& a, const PathOutcome& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.blocked_by, b.blocked_by);
  EXPECT_EQ(a.waypoints, b.waypoints);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.energy, b.energy);
}

terrain::Site with_occupancy(const terrain::Site& site, const std::function<terrain::Occupancy(Cell)>& says) {
  terrain::SiteLayers layers = site.layers();
  for (std::size_t i = 0; i < layers.occupancy.size(); ++i)
    layers.occupancy[i] = says(site.grid().cell_at(i));
  return {site.grid(), layers};
}

terrain::Site with_unknown(int side, const std::function<bool(Cell)>& is_unknown) {
  return with_occupancy(made_site(side, 1.0, level, no_rocks), [&](Cell c) {
    return is_unknown(c) ? terrain::Occupancy::unknown : terrain::Occupancy::free;
  });
}

// A wall along one column, whose only gap is three cells of unknown ground about a row.
terrain::Site with_wall(const terrain::Site& site, int column, int gap) {
  return with_occupancy(site, [&](Cell c) {
    if (c.column != column) return terrain::Occupancy::free;
    return std::abs(c.row - gap) <= 1 ? terrain::Occupancy::unknown : terrain::Occupancy::occupied;
  });
}

TEST(Table, LowerBoundsAreNeverAboveWhatAPathCosts) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    std::mt19937_64 random(seed);
    PathPlanner planner(random_site(seed, 36, 40), {}, random_drive(random));
    planner.set_discs({{random_point(random, planner.map().grid()), 2}});
    for (int k = 0; k < 25; ++k) {
      const Point from = random_point(random, planner.map().grid());
      const Point to = k % 10 == 0 ? from : random_point(random, planner.map().grid());
      const PathOutcome bound = planner.lower_bound(from, to);
      const PathOutcome exact = planner.cost(from, to);
      ASSERT_EQ(bound.status, exact.status);
      EXPECT_EQ(bound.blocked_by, exact.blocked_by);
      EXPECT_LE(bound.length, exact.length);
      EXPECT_LE(bound.time, exact.time);
      EXPECT_LE(bound.energy, exact.energy);
      EXPECT_GE(bound.energy, 0);
      if (exact.status == PathStatus::found && exact.time > 0) ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Table, OnLevelGroundTheLowerBoundIsTheCost) {
  PathPlanner planner(made_site(40, 1.0, level, no_rocks), {}, {});
  const PathOutcome bound = planner.lower_bound({5, 5}, {30, 22});
  const PathOutcome exact = planner.cost({5, 5}, {30, 22});
  EXPECT_NEAR(bound.time, exact.time, 1e-3 * exact.time);
  EXPECT_NEAR(bound.energy, exact.energy, 1e-3 * exact.energy);
  EXPECT_EQ(planner.work().searches, 1U) << "the exact value alone";
}

TEST(Table, LowerBoundsSearchNothing) {
  PathPlanner planner(random_site(5, 40, 60), {}, {});
  std::mt19937_64 random(5);
  for (int k = 0; k < 200; ++k) {
    planner.lower_bound(random_point(random, planner.map().grid()),
                        random_point(random, planner.map().grid()));
  }
  EXPECT_EQ(planner.work().searches, 0U);
  EXPECT_EQ(planner.work().paths, 0U);
}

TEST(Table, TakesOneSearchForEachPlace) {
  PathPlanner planner(made_site(40, 1.0, level, no_rocks), {}, {});
  const std::vector<Point> places{{5, 5}, {30, 8}, {20, 20}, {8, 33}, {33, 33}};
  for (int round = 0; round < 2; ++round) {
    for (const Point from : places) {
      for (const Point to : places) planner.cost(from, to);
    }
  }
  EXPECT_EQ(planner.work().searches, places.size());
  EXPECT_EQ(planner.work().paths, places.size() * places.size());
}

// What is kept after obstacles come and go is what a new planner says, to the last bit.
TEST(Table, KeepsWhatANewPlannerWouldSay) {
  std::uint64_t kept = 0, unknown = 0, unreachable = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const bool walled = seed > 4;
    const terrain::Site open = random_site(seed, 64, 60);
    const terrain::Site site = walled ? with_wall(open, 32, 30) : open;
    PathPlanner planner(site, {}, {});
    std::mt19937_64 random(seed);
    std::vector<Point> places;
    while (places.size() < 5) {
      const Point p = random_point(random, planner.map().grid());
      if (planner.map().is_free(p)) places.push_back(p);
    }
    std::vector<Disc> discs;
    for (int change = 0; change < 5; ++change) {
      for (const Point from : places) {
        for (const Point to : places) planner.path(from, to);
      }
      if (change == 3) {
        discs.erase(discs.begin());  // what was behind it may be better
      } else if (walled && change == 0) {
        discs.push_back({{32, 30}, 0.2});  // covers no middle of a cell, and closes the gap
      } else {
        discs.push_back({random_point(random, planner.map().grid()), uniform(random, 0, 3)});
      }
      planner.set_discs(discs);
      PathPlanner fresh(site, {}, {});
      fresh.set_discs(discs);
      const std::uint64_t before = planner.work().paths;
      for (const Point from : places) {
        for (const Point to : places) {
          const PathOutcome expected = fresh.path(from, to);
          expect_same(planner.path(from, to), expected);
          unknown += expected.status == PathStatus::unknown ? 1 : 0;
          unreachable += expected.status == PathStatus::unreachable ? 1 : 0;
        }
      }
      kept += fresh.work().paths - (planner.work().paths - before);
    }
  }
  EXPECT_GT(kept, 50U) << "most obstacles lie in nobody's way";
  EXPECT_GT(unknown, 20U) << "through the gap";
  EXPECT_GT(unreachable, 20U) << "while it is closed";
}

TEST(Table, AnObstacleFarAwayCostsNothing) {
  PathPlanner planner(made_site(100, 1.0, level, no_rocks), {}, {});
  planner.cost({10, 10}, {30, 12});
  planner.cost({10, 90}, {30, 90});
  ASSERT_TRUE(planner.set_discs({{{20, 90}, 2}}));
  planner.cost({10, 10}, {30, 12});
  EXPECT_EQ(planner.work().paths, 2U);
  planner.cost({10, 90}, {30, 90});
  EXPECT_EQ(planner.work().paths, 3U);
  ASSERT_TRUE(planner.set_discs({}));
  planner.cost({10, 10}, {30, 12});
  EXPECT_EQ(planner.work().paths, 4U) << "what goes may open a better way for anybody";
}

// The places of a long mission drift over the map; what was asked for lately stays, the rest goes.
TEST(Table, WhatNobodyAsksForAnyMoreIsForgotten) {
  const terrain::Site site = made_site(60, 1.0, level, no_rocks);
  PathPlanner planner(site, {}, {});
  const Point home{30, 30};
  const Point depot{40, 35};
  std::mt19937_64 random(7);
  std::uint64_t paths = 0;
  for (int day = 0; day < 60; ++day) {
    const Point place{uniform(random, 3, 57), uniform(random, 3, 57)};
    expect_same(planner.path(place, depot), PathPlanner(site, {}, {}).path(place, depot));
    planner.cost(home, depot);
    paths += day == 0 ? 2 : 1;
    ASSERT_EQ(planner.work().paths, paths) << "the way that is asked for each day is worked out once";
    planner.forget_unasked();
    ASSERT_LE(planner.kept().answers, 2U);
    ASSERT_LE(planner.kept().trees, 2U);
  }
  planner.forget_unasked();
  EXPECT_EQ(planner.kept().answers + planner.kept().trees, 0U);
  expect_same(planner.path(home, depot), PathPlanner(site, {}, {}).path(home, depot));
  EXPECT_EQ(planner.work().paths, paths + 1);
}

// A tree stays in use after obstacles were added, and its ways are those of a new search.
TEST(Table, AWayThatHoldsIsTheWayOfANewSearch) {
  int held = 0;
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::mt19937_64 random(seed);
    // Level ground has many ways of equal cost.
    Costmap map(seed % 2 == 0 ? made_site(30, 1.0, level, no_rocks) : random_site(seed, 30, 50), {});
    const GridSearch search(map, {});
    const Cell source{static_cast<int>(random() % 26) + 2, static_cast<int>(random() % 26) + 2};
    const SearchTree before = search.from(map, source);
    map.set_discs({{random_point(random, map.grid()), 1}, {random_point(random, map.grid()), 2}});
    const SearchTree after = search.from(map, source);
    for (std::size_t i = 0; i < map.grid().cell_count(); ++i) {
      const Cell target = map.grid().cell_at(i);
      if (!before.holds(map, target)) {
        broken += before.reaches(target) ? 1 : 0;
        continue;
      }
      ASSERT_EQ(before.path_to(target), after.path_to(target));
      ++held;
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(broken, 100);
}

// The bound of README.md: with turns, a path takes no longer than the best way over the grid; without them, at most a
// quarter longer, since a rover that turns slowly takes a detour for fewer turns.
TEST(Table, PathsLieWithinTheStatedBoundOfAnExactGridSearch) {
  constexpr double kBound = 0.25;
  double worst = -1;
  int paths = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    std::mt19937_64 random(seed);
    const DriveModel drive = seed == 1 ? DriveModel{} : random_drive(random);
    PathPlanner planner(random_site(seed, 40, seed % 3 == 0 ? 15 : 40), {}, drive);
    const GridSearch search(planner.map(), drive);
    const terrain::Grid& grid = planner.map().grid();
    for (int k = 0; k < 40; ++k) {
      const Point from = random_point(random, grid);
      const Point to = random_point(random, grid);
      if (!planner.map().is_free(from)) continue;
      Polyline exact = search.from(planner.map(), grid.cell_of(from)).path_to(grid.cell_of(to));
      if (exact.size() < 2) continue;
      exact.front() = from;
      exact.back() = to;
      const PathOutcome path = planner.path(from, to);
      ASSERT_EQ(path.status, PathStatus::found);
      EXPECT_LE(path.time, measure(planner.map(), drive, exact).time * (1 + 1e-9));
      double driving = 0;
      for (std::size_t i = 1; i < path.waypoints.size(); ++i)
        driving += drive_time(planner.map(), drive, path.waypoints[i - 1], path.waypoints[i]);
      double on_grid = 0;
      for (std::size_t i = 1; i < exact.size(); ++i)
        on_grid += drive_time(planner.map(), drive, exact[i - 1], exact[i]);
      worst = std::max(worst, driving / on_grid - 1);
      ++paths;
    }
  }
  EXPECT_LE(worst, kBound);
  EXPECT_GT(paths, 250);
  RecordProperty("worst", std::to_string(worst));
}

TEST(Table, WhatLiesBehindUnknownGroundIsNotKnownToBeUnreachable) {
  // A strip of unknown ground parts the map; the wall of discs beside it does so for good.
  PathPlanner planner(with_unknown(40, [](Cell c) { return c.column == 20; }), {}, {});
  EXPECT_EQ(planner.map().unknown_cells(), 40U);
  EXPECT_EQ(planner.cost({5, 20}, {15, 5}).status, PathStatus::found);
  EXPECT_EQ(planner.cost({5, 20}, {35, 20}).status, PathStatus::unknown);
  EXPECT_EQ(planner.lower_bound({5, 20}, {35, 20}).status, PathStatus::unknown);
  const PathOutcome into = planner.cost({5, 20}, {20.5, 20});
  EXPECT_EQ(into.status, PathStatus::unknown);
  EXPECT_EQ(into.blocked_by, CellState::unknown);
  std::vector<Disc> wall;
  for (double y = 0; y <= 40; y += 2) wall.push_back({{28, y}, 1});
  planner.set_discs(wall);
  EXPECT_EQ(planner.cost({5, 20}, {35, 20}).status, PathStatus::unreachable) << "known ground proves it";
  EXPECT_EQ(planner.cost({5, 20}, {28, 20}).status, PathStatus::goal_blocked);
  planner.set_discs({});
  EXPECT_EQ(planner.cost({5, 20}, {35, 20}).status, PathStatus::unknown);
}

// An obstacle in unknown ground shows in no cell that the rover may or may not enter, and counts for what is proved.
TEST(Table, WhatAnObstacleInUnknownGroundCloses) {
  PathPlanner planner(with_wall(made_site(40, 1.0, level, no_rocks), 20, 20), {}, {});
  const Disc in_gap{{20, 20}, 0.2}, elsewhere{{8, 8}, 1};
  const auto across = [&] { return planner.cost({5, 20}, {35, 20}).status; };
  EXPECT_EQ(across(), PathStatus::unknown);
  EXPECT_TRUE(planner.set_discs({in_gap})) << "the answers are other ones";
  EXPECT_EQ(across(), PathStatus::unreachable);
  EXPECT_TRUE(planner.set_discs({in_gap, elsewhere}));
  EXPECT_EQ(across(), PathStatus::unreachable);
  const std::uint64_t version = planner.map().version();
  EXPECT_TRUE(planner.set_discs({elsewhere}));
  EXPECT_EQ(across(), PathStatus::unknown);
  EXPECT_EQ(planner.map().version(), version + 1);
  EXPECT_FALSE(planner.set_discs({elsewhere}));
}

TEST(Table, UnknownGroundIsNotDrivenOver) {
  PathPlanner planner(
      with_unknown(40, [](Cell c) { return c.column > 15 && c.column < 25 && c.row > 8 && c.row < 32; }), {},
      {});
  const PathOutcome around = planner.path({5, 20}, {35, 20});
  ASSERT_EQ(around.status, PathStatus::found);
  for (const Point p : densify(around.waypoints, 0.05)) {
    EXPECT_FALSE(p.x > 16 - 0.79 && p.x < 25 + 0.79 && p.y > 9 && p.y < 32) << p.x << ", " << p.y;
  }
}

}  // namespace
}  // namespace roci::pathplan
