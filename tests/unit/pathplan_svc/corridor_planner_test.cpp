#include "pathplan_svc/corridor_planner.hpp"

#include <gtest/gtest.h>

#include "pathplan_svc/grid_search.hpp"
#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

class Corridor : public testing::Test {
 protected:
  Corridor() : map_(random_site(9, 90, 60), {}), search_(map_, drive_) {}

  Polyline guide(terrain::Cell from, terrain::Cell to) const { return search_.from(map_, from).path_to(to); }

  terrain::Cell free_cell(std::mt19937_64& random) const {
    while (true) {
      const terrain::Cell c{static_cast<int>(random() % 90), static_cast<int>(random() % 90)};
      if (map_.is_free(c)) return c;
    }
  }

  DriveModel drive_;
  Costmap map_;
  GridSearch search_;
};

TEST_F(Corridor, PathsAreFreeAndJoinTheEnds) {
  std::mt19937_64 random(61);
  int found = 0;
  for (int k = 0; k < 40; ++k) {
    const Polyline line = guide(free_cell(random), free_cell(random));
    if (line.size() < 2) continue;
    const auto path = plan_in_corridor(map_, drive_, line, {}, static_cast<std::uint64_t>(k));
    if (!path) continue;
    ++found;
    EXPECT_EQ(path->front(), line.front());
    EXPECT_EQ(path->back(), line.back());
    for (std::size_t i = 1; i < path->size(); ++i) EXPECT_TRUE(is_free(map_, (*path)[i - 1], (*path)[i]));
  }
  EXPECT_GE(found, 35);
}

TEST_F(Corridor, TheSeedAloneDecides) {
  std::mt19937_64 random(62);
  const Polyline line = guide(free_cell(random), free_cell(random));
  const auto first = plan_in_corridor(map_, drive_, line, {}, 7);
  ASSERT_TRUE(first);
  for (int k = 0; k < 5; ++k) {
    plan_in_corridor(map_, drive_, guide(free_cell(random), free_cell(random)), {}, random());
    EXPECT_EQ(plan_in_corridor(map_, drive_, line, {}, 7), first);
  }
  EXPECT_NE(plan_in_corridor(map_, drive_, line, {}, 8), first);
}

TEST_F(Corridor, AGuideWithoutALineGivesNothing) {
  EXPECT_FALSE(plan_in_corridor(map_, drive_, {}, {}, 1));
  EXPECT_FALSE(plan_in_corridor(map_, drive_, {{5, 5}}, {}, 1));
}

}  // namespace
}  // namespace roci::pathplan
