#include "pathplan_svc/grid_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

bool may_move(const Costmap& map, terrain::Cell from, terrain::Cell to) {
  return map.is_free(from) && map.is_free(to) && map.is_free(terrain::Cell{from.column, to.row}) &&
         map.is_free(terrain::Cell{to.column, from.row});
}

double time_of(const Costmap& map, const DriveModel& drive, const Polyline& path) {
  double time = 0;
  for (std::size_t i = 1; i < path.size(); ++i) time += measure(map, drive, path[i - 1], path[i]).time;
  return time;
}

// Bellman-Ford over the moves, priced by measure(): shares nothing with the search but the map.
std::vector<double> oracle(const Costmap& map, const DriveModel& drive, terrain::Cell source) {
  const terrain::Grid& grid = map.grid();
  std::vector<double> cost(grid.cell_count(), std::numeric_limits<double>::infinity());
  cost[grid.index(source)] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < cost.size(); ++i) {
      const terrain::Cell here = grid.cell_at(i);
      if (std::isinf(cost[i])) continue;
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          const terrain::Cell next{here.column + dx, here.row + dy};
          if (next == here || !may_move(map, here, next)) continue;
          const double through = cost[i] + measure(map, drive, grid.centre(here), grid.centre(next)).time;
          if (through < cost[grid.index(next)] - 1e-9) {
            cost[grid.index(next)] = through;
            changed = true;
          }
        }
      }
    }
  }
  return cost;
}

TEST(GridSearch, FindsTheOptimumOnRandomMaps) {
  const DriveModel drive;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Costmap map(random_site(seed, 26, seed % 2 == 0 ? 18 : 40), {});
    const GridSearch search(map, drive);
    const Regions regions(map);
    std::mt19937_64 random(seed);
    for (int k = 0; k < 3; ++k) {
      const terrain::Cell source{static_cast<int>(random() % 26), static_cast<int>(random() % 26)};
      const SearchTree tree = search.from(map, source);
      if (!map.is_free(source)) {
        EXPECT_FALSE(tree.reaches(source));
        continue;
      }
      const std::vector<double> best = oracle(map, drive, source);
      for (std::size_t i = 0; i < best.size(); ++i) {
        const terrain::Cell target = map.grid().cell_at(i);
        ASSERT_EQ(tree.reaches(target), std::isfinite(best[i]));
        ASSERT_EQ(tree.reaches(target), regions.region(i) == regions.region(map.grid().index(source)));
        if (!tree.reaches(target)) continue;
        const Polyline path = tree.path_to(target);
        ASSERT_EQ(path.front(), map.grid().centre(source));
        ASSERT_EQ(path.back(), map.grid().centre(target));
        ASSERT_NEAR(time_of(map, drive, path), best[i], 1e-4 * best[i] + 1e-9);
        for (std::size_t j = 1; j < path.size(); ++j) ASSERT_TRUE(is_free(map, path[j - 1], path[j]));
      }
    }
  }
}

TEST(GridSearch, NoRandomWalkIsFaster) {
  const DriveModel drive;
  const Costmap map(random_site(31, 40, 50), {});
  const GridSearch search(map, drive);
  std::mt19937_64 random(32);
  int walks = 0;
  while (walks < 200) {
    terrain::Cell here{static_cast<int>(random() % 40), static_cast<int>(random() % 40)};
    if (!map.is_free(here)) continue;
    Polyline walk{map.grid().centre(here)};
    const SearchTree tree = search.from(map, here);
    const int drift_x = static_cast<int>(random() % 3) - 1;
    for (int step = 0; step < 60; ++step) {
      const terrain::Cell next{
          here.column + (random() % 2 == 0 ? drift_x : static_cast<int>(random() % 3) - 1),
          here.row + static_cast<int>(random() % 3) - 1};
      if (!may_move(map, here, next) || next == here) continue;
      here = next;
      walk.push_back(map.grid().centre(here));
    }
    ASSERT_LE(time_of(map, drive, tree.path_to(here)), time_of(map, drive, walk) * (1 + 1e-5) + 1e-9);
    ++walks;
  }
}

TEST(GridSearch, ReachabilityIsSymmetric) {
  const DriveModel drive;
  const Costmap map(random_site(41, 30, 8), {});
  const GridSearch search(map, drive);
  EXPECT_GT(Regions(map).count(), 1U);
  std::mt19937_64 random(42);
  for (int k = 0; k < 60; ++k) {
    const terrain::Cell a{static_cast<int>(random() % 30), static_cast<int>(random() % 30)};
    const terrain::Cell b{static_cast<int>(random() % 30), static_cast<int>(random() % 30)};
    EXPECT_EQ(search.from(map, a).reaches(b), search.from(map, b).reaches(a));
  }
}

}  // namespace
}  // namespace roci::pathplan
