#include "sim_svc/world/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace roci::sim::world {
namespace {

TEST(Surface, TheSunStandsWhereItWasPutOrGoesItsWay) {
  const Direction still = toward({90, 30}, temporal::seconds(5000));
  EXPECT_NEAR(still.north, std::cos(30 * std::acos(-1) / 180), 1e-9);
  EXPECT_NEAR(still.up, 0.5, 1e-9);
  const Sun moving{0, 0, 88775, 40000, 18};
  EXPECT_GT(toward(moving, temporal::seconds(30000)).east, 0.5) << "in the east before noon";
  const Direction noon = toward(moving, temporal::seconds(40000));
  EXPECT_NEAR(noon.up, std::cos(18 * std::acos(-1) / 180), 1e-6);
  EXPECT_LT(noon.north, 0) << "in the south at noon, for a northern site";
  EXPECT_LT(toward(moving, temporal::seconds(40000 + 88775.0 / 2)).up, 0) << "night";
}

TEST(Surface, ScattersTargetsByTheSeedWhoeverAsksFromWhere) {
  Surface surface;
  surface.odd_per_hectare = 30;
  surface.seed = 4;
  const auto all = oddities_near(surface, {100, 100}, 100);
  EXPECT_NEAR(static_cast<double>(all.size()), 30 * 3.14, 45);
  for (const Oddity& one : oddities_near(surface, {60, 110}, 20))
    EXPECT_NE(std::ranges::find(all, one), all.end()) << one.x << ", " << one.y;
  surface.seed = 5;
  EXPECT_NE(oddities_near(surface, {100, 100}, 100), all);
}

TEST(Surface, KnowsThePlacedTargetsWithinReachAlone) {
  Surface surface;
  surface.placed = {{10, 10, 1, Look::dark}, {50, 10, 1, Look::bright}};
  const auto near = oddities_near(surface, {12, 10}, 20);
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].look, Look::dark);
}

}  // namespace
}  // namespace roci::sim::world
