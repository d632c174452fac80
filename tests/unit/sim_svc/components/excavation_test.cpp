// The physics of a trench against numerical integration.
#include "sim_svc/components/excavation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace roci::sim::components {
namespace {

constexpr double kDepth = 0.1;  // m

IceColumn column(const Ice& ice, std::uint64_t seed = 1) {
  return {ice, kDepth, world::RandomStream(seed, "ice")};
}

// Cuts in small steps of time.
double integrated_depth(const IceColumn& ice, double from_m, double cutting_s, const Cutter& cutter) {
  constexpr double kStep = 0.01;  // s
  double depth = from_m;
  for (double t = 0; t < cutting_s && depth < ice.bottom_m(); t += kStep)
    depth += kStep * cutter.power_w / (ice.specific_energy_j_m3(depth) * cutter.area_m2);
  return std::min(depth, ice.bottom_m());
}

TEST(Excavation, EvenIceTakesItsVolumeTimesItsSpecificEnergy) {
  const IceColumn ice = column({2e9, 0.01, 0, {}});
  const Cutter cutter{120, 0.03};
  EXPECT_NEAR(ice.cutting_s(0, kDepth, cutter), 2e9 * 0.03 * kDepth / 120, 1e-6);
  EXPECT_NEAR(ice.cutting_s(0.025, 0.075, cutter), 2e9 * 0.03 * 0.05 / 120, 1e-6);
  EXPECT_NEAR(ice.depth_after(0, 25000, cutter), 0.05, 1e-12);
}

TEST(Excavation, IsWhatNumericalIntegrationMakesOfLayeredIce) {
  const Cutter cutter{100, 0.01};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const IceColumn ice = column({1e9, 0.007, 0.4, {}}, seed);
    for (const double from : {0.0, 0.013, 0.07}) {
      for (const double s : {0.0, 500.0, 3000.0, 40000.0})
        EXPECT_NEAR(ice.depth_after(from, s, cutter), integrated_depth(ice, from, s, cutter), 2e-6)
            << "seed " << seed << ", from " << from << " m, " << s << " s";
    }
  }
}

TEST(Excavation, DepthAndTimeFollowFromEachOther) {
  const Cutter cutter{80, 0.02};
  const IceColumn ice = column({1.5e9, 0.01, 0.3, {}}, 7);
  for (double to = 0.003; to < kDepth; to += 0.0037) {
    const double s = ice.cutting_s(0.002, to, cutter);
    EXPECT_NEAR(ice.depth_after(0.002, s, cutter), to, 1e-9);
    // and in two goes as in one
    const double half = ice.depth_after(0.002, s / 2, cutter);
    EXPECT_NEAR(ice.depth_after(half, s / 2, cutter), to, 1e-9);
  }
}

TEST(Excavation, DifferentSeedsHaveOtherLayersAndOneSeedTheSame) {
  const Cutter cutter;
  const Ice ice{1e9, 0.01, 0.2, {}};
  EXPECT_EQ(column(ice, 3).cutting_s(0, kDepth, cutter), column(ice, 3).cutting_s(0, kDepth, cutter));
  EXPECT_NE(column(ice, 3).cutting_s(0, kDepth, cutter), column(ice, 4).cutting_s(0, kDepth, cutter));
}

TEST(Excavation, NothingGoesDeeperThanTheIceGivesWay) {
  const IceColumn ice = column({1e9, 0.01, 0, 0.04});
  EXPECT_FALSE(ice.passable());
  EXPECT_EQ(ice.bottom_m(), 0.04);
  EXPECT_EQ(ice.depth_after(0, 1e9, {100, 0.01}), 0.04);
  EXPECT_TRUE(column({1e9, 0.01, 0, 0.4}).passable());
}

}  // namespace
}  // namespace roci::sim::components
