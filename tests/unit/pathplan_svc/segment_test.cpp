#include "pathplan_svc/segment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/pathplan_svc/made_sites.hpp"

namespace roci::pathplan {
namespace {

TEST(Segment, CostAndFreedomAgreeWithFineSampling) {
  std::mt19937_64 random(21);
  const Costmap map(random_site(6, 50, 80), {});
  const DriveModel drive;
  int free = 0;
  for (int k = 0; k < 300; ++k) {
    const terrain::Point a{uniform(random, 1, 49), uniform(random, 1, 49)};
    const terrain::Point b{uniform(random, 1, 49), uniform(random, 1, 49)};
    const double length = terrain::distance(a, b);
    constexpr int kSteps = 20000;
    double time = 0;
    double energy = 0;
    CellState worst = CellState::free;
    for (int i = 0; i < kSteps; ++i) {
      const double share = (i + 0.5) / kSteps;
      const terrain::Point p{a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
      const std::size_t cell = map.grid().index(map.grid().cell_of(p));
      const terrain::Gradient g = map.gradient(cell);
      const Pace pace =
          drive.pace((g.east * (b.x - a.x) + g.north * (b.y - a.y)) / length, map.roughness(cell));
      time += pace.time * length / kSteps;
      energy += pace.energy * length / kSteps;
      worst = std::max(worst, map.state(cell));
    }
    const SegmentCost cost = measure(map, drive, a, b);
    EXPECT_NEAR(cost.length, length, 1e-9);
    EXPECT_NEAR(cost.time, time, 2e-3 * time);
    EXPECT_NEAR(cost.energy, energy, 2e-3 * energy);
    EXPECT_EQ(cost.free, worst == CellState::free);
    EXPECT_EQ(is_free(map, a, b), cost.free);
    EXPECT_EQ(worst_state(map, a, b), worst);
    free += cost.free ? 1 : 0;
  }
  EXPECT_GT(free, 30);
}

TEST(Segment, LinesAlongBordersAndThroughCornersStayOnTheMap) {
  const Costmap map(made_site(10, 1.0, level, no_rocks), {});
  const DriveModel drive;
  for (const auto& [a, b] : {std::pair{terrain::Point{2, 2}, terrain::Point{8, 8}},
                             std::pair{terrain::Point{8, 8}, terrain::Point{2, 2}},
                             std::pair{terrain::Point{2, 8}, terrain::Point{8, 2}},
                             std::pair{terrain::Point{5, 2}, terrain::Point{5, 8}},
                             std::pair{terrain::Point{8, 5}, terrain::Point{2, 5}}}) {
    const SegmentCost cost = measure(map, drive, a, b);
    EXPECT_TRUE(cost.free);
    EXPECT_NEAR(cost.time, terrain::distance(a, b) / drive.speed, 1e-9);
  }
}

TEST(Segment, TurnsOnTheSpotAreCounted) {
  const Costmap map(made_site(12, 1.0, level, no_rocks), {});
  const DriveModel drive;
  const double pi = std::acos(-1.0);
  const SegmentCost cost = measure(map, drive, Polyline{{2, 2}, {6, 2}, {6, 5}, {3, 2}});
  const double turned = pi / 2 + pi / 2 + 3 * pi / 4;  // the unknown first one, left, and 135° more
  EXPECT_NEAR(cost.time, (4 + 3 + std::sqrt(18)) / drive.speed + turned / drive.turn_rate, 1e-9);
  EXPECT_EQ(measure(map, drive, Polyline{{2, 2}}).time, 0);
}

TEST(Segment, TurnsTakeTheShorterWayRound) {
  EXPECT_NEAR(turn_between(3.0, -3.0), 2 * std::acos(-1.0) - 6, 1e-12);
  EXPECT_NEAR(turn_between(-1.0, 0.5), 1.5, 1e-12);
}

TEST(Segment, DensifyingKeepsTheLine) {
  const Polyline line{{0, 0}, {10, 0}, {10, 3}, {10, 3}};
  const Polyline dense = densify(line, 4.0);
  double length = 0;
  for (std::size_t i = 1; i < dense.size(); ++i) {
    const double step = terrain::distance(dense[i - 1], dense[i]);
    EXPECT_LE(step, 4.0);
    length += step;
  }
  EXPECT_NEAR(length, 13, 1e-12);
  EXPECT_EQ(dense.front(), line.front());
  EXPECT_EQ(dense.back(), line.back());
}

}  // namespace
}  // namespace roci::pathplan
