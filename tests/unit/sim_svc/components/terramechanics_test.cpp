#include "sim_svc/components/terramechanics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::sim::components {
namespace {

const WheeledVehicle kHeavy{2400, 6, 0.1, 0.3};
const WheeledVehicle kLight{180, 4, 0.06, 0.4};

world::Soil dry_sand() { return {}; }  // Wong, "Theory of Ground Vehicles", table 2.3

world::Soil trap() {
  world::Soil soil;
  soil.frictional_modulus = 2e5;
  return soil;
}

double uniform(pseudorandom::SplitMix64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random.next() >> 11) * 0x1p-53;
}

// By hand: W = 400 N, k = 990 + 0.1 · 1528430 = 153833; z = (1200 / (1.9 · 153833 · √0.3))^(2/3.2) = 0.0470 m;
// R = 153833 · z^2.1 / 2.1 = 119.1 N a wheel.
TEST(Terramechanics, ComputesBekkersSinkageAndResistance) {
  const Footing out = footing(dry_sand(), kHeavy, 0, 0);
  EXPECT_NEAR(out.sinkage_m, 0.0470, 1e-4);
  EXPECT_NEAR(out.resistance_n, 6 * 119.1, 2);
  EXPECT_TRUE(out.bears);
}

TEST(Terramechanics, TheSlipBalancesThrustAndResistance) {
  pseudorandom::SplitMix64 random(7);
  int bearing = 0;
  for (int i = 0; i < 2000; ++i) {
    world::Soil soil;
    soil.exponent = uniform(random, 0.5, 1.5);
    soil.frictional_modulus = uniform(random, 2e5, 4e6);
    soil.cohesion_pa = uniform(random, 0, 5000);
    soil.friction_deg = uniform(random, 20, 40);
    soil.shear_m = uniform(random, 0.005, 0.04);
    const WheeledVehicle vehicle{uniform(random, 100, 3000), 4, uniform(random, 0.05, 0.2),
                                 uniform(random, 0.2, 0.5)};
    const double pitch = uniform(random, -0.3, 0.3);
    const Footing out = footing(soil, vehicle, pitch, std::abs(pitch));
    if (!out.bears) {
      EXPECT_EQ(out.slip, 1);
      continue;
    }
    ++bearing;
    const double load = vehicle.weight_n * std::cos(pitch) / vehicle.wheels;
    const double arc =
        vehicle.wheel_diameter_m / 2 * std::acos(1 - 2 * out.sinkage_m / vehicle.wheel_diameter_m);
    const double needed = (out.resistance_n + vehicle.weight_n * std::sin(pitch)) / vehicle.wheels;
    const double strength = vehicle.wheel_width_m * arc * soil.cohesion_pa +
                            load * std::tan(soil.friction_deg * std::numbers::pi / 180);
    if (needed <= 0) {
      EXPECT_EQ(out.slip, 0);
      continue;
    }
    const double x = out.slip * arc / soil.shear_m;
    EXPECT_NEAR(strength * (1 - (1 - std::exp(-x)) / x), needed, 1e-5 * strength) << "slip " << out.slip;
  }
  EXPECT_GT(bearing, 500);
}

TEST(Terramechanics, ATrapHoldsTheHeavyOneAndLetsTheLightOnePass) {
  EXPECT_FALSE(footing(trap(), kHeavy, 0, 0).bears);
  const Footing light = footing(trap(), kLight, 0, 0);
  EXPECT_TRUE(light.bears);
  EXPECT_GT(light.slip, 0.02);
  EXPECT_GT(light.sinkage_m, footing(dry_sand(), kLight, 0, 0).sinkage_m);
}

TEST(Terramechanics, UphillSlipsMoreUntilItDoesNotBear) {
  double before = 0;
  bool held = false;
  for (double pitch = 0; pitch < 0.6; pitch += 0.01) {
    const Footing out = footing(dry_sand(), kHeavy, pitch, pitch);
    EXPECT_GE(out.slip, before);
    EXPECT_TRUE(out.bears || out.slip == 1);
    EXPECT_FALSE(held && out.bears);
    held = held || !out.bears;
    before = out.slip;
  }
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace roci::sim::components
