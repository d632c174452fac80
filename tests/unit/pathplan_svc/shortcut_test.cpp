#include "pathplan_svc/shortcut.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pathplan_svc/grid_search.hpp"
#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

bool all_free(const Costmap& map, const Polyline& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!is_free(map, path[i - 1], path[i])) return false;
  }
  return true;
}

// Paths over the grid between random free cells.
std::vector<Polyline> some_paths(const Costmap& map, const DriveModel& drive, std::size_t count) {
  const GridSearch search(map, drive);
  const int side = map.grid().columns;
  std::mt19937_64 random(51);
  std::vector<Polyline> paths;
  while (paths.size() < count) {
    const auto cell = [&] {
      return terrain::Cell{static_cast<int>(random() % static_cast<unsigned>(side)),
                           static_cast<int>(random() % static_cast<unsigned>(side))};
    };
    Polyline path = search.from(map, cell()).path_to(cell());
    if (path.size() > 2) paths.push_back(std::move(path));
  }
  return paths;
}

TEST(Shortcut, IsTheBestOfAllSubsetsOfCorners) {
  const DriveModel drive;
  const Costmap map(random_site(7, 14, 25), {});
  for (const Polyline& path : some_paths(map, drive, 60)) {
    double best = std::numeric_limits<double>::infinity();
    const std::size_t inner = path.size() - 2;
    for (unsigned subset = 0; subset < (1U << inner); ++subset) {
      Polyline candidate{path.front()};
      for (std::size_t i = 0; i < inner; ++i) {
        if ((subset >> i & 1U) != 0) candidate.push_back(path[i + 1]);
      }
      candidate.push_back(path.back());
      if (all_free(map, candidate)) best = std::min(best, measure(map, drive, candidate).time);
    }
    EXPECT_NEAR(measure(map, drive, shortcut(map, drive, path, 1000)).time, best, 1e-9);
  }
}

TEST(Shortcut, ThinnedPathsStayFreeAndShort) {
  const DriveModel drive;
  const Costmap map(random_site(8, 80, 40), {});
  for (const Polyline& path : some_paths(map, drive, 20)) {
    const Polyline thinned = thin(map, path, 15);
    EXPECT_TRUE(all_free(map, thinned));
    EXPECT_EQ(thinned.front(), path.front());
    EXPECT_EQ(thinned.back(), path.back());
    EXPECT_LE(thinned.size(), path.size());
    const Polyline cut = shortcut(map, drive, thinned, 20);
    EXPECT_TRUE(all_free(map, cut));
    EXPECT_LE(measure(map, drive, cut).time, measure(map, drive, thinned).time + 1e-9);
  }
}

}  // namespace
}  // namespace roci::pathplan
