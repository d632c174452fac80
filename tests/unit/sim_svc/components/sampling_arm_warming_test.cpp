// What a sampling arm warms beside its zone: how long that takes and what it draws, by what surrounds the robot.
#include <gtest/gtest.h>

#include <cmath>

#include "sim_svc/world/cold_part.hpp"
#include "tests/unit/sim_svc/sampler.hpp"

namespace roci::sim::components {
namespace {

using world::ColdPart;

const ColdPart kDrill{7000, 0.5, 195, 200, 100};

// Newton's law by small steps.
double integrated_s(const ColdPart& part, double surroundings_k, double loss_factor = 1) {
  double kelvin = surroundings_k, s = 0;
  for (; kelvin < part.work_k; s += 0.01)
    kelvin +=
        0.01 * (part.heater_w - part.loss_w_k * loss_factor * (kelvin - surroundings_k)) / part.capacity_j_k;
  return s;
}

// A sampler in such surroundings whose arm is prepared, has dug, and has collected a sample. Its zone keeps the
// temperature at which it works, so that nothing but the drill is warmed.
SamplerFlight collected(double surroundings_k, bool warms, double loss_factor = 1, double heater_w = 195) {
  Sampler sampler;
  sampler.make_cold();
  sampler.thermal->surroundings_k = surroundings_k;
  sampler.thermal->loss_factor = loss_factor;
  for (auto& zone : sampler.thermal->zones) zone.start_k = zone.keep_k = zone.work_k;
  if (warms) sampler.arm.warms["collect"] = {7000, 0.5, heater_w, 200, 100};
  SamplerFlight run(sampler);
  EXPECT_EQ(run.arm("prepare"), "done");
  EXPECT_EQ(run.arm("excavate", {{"site", "0"}}), "done");
  run.arm("collect", {{"site", "0"}, {"target", "0"}});
  return run;
}

TEST(Warming, AgreesWithIntegration) {
  for (const double kelvin : {40.0, 85.0, 100.0, 150.0})
    for (const double factor : {0.7, 1.0, 1.5})
      EXPECT_NEAR(world::warming(kDrill, kelvin, factor)->seconds, integrated_s(kDrill, kelvin, factor), 1);
  EXPECT_NEAR(world::warming(kDrill, 85)->holding_w, 57.5, 1e-9);
}

TEST(Warming, IsNothingWhereItIsWarmAndNeverEndsWhereTheHeaterIsTooWeak) {
  EXPECT_EQ(world::warming(kDrill, 200)->seconds, 0);
  EXPECT_EQ(world::warming(kDrill, 250)->holding_w, 0);
  EXPECT_FALSE(world::warming(kDrill, 100, 3.9));
}

TEST(SamplingArmWarming, IsPartOfWhatACommandUsuallyTakes) {
  const SamplerFlight with = collected(100, true), without = collected(100, false);
  EXPECT_EQ(with.seconds_taken(), without.seconds_taken());
  EXPECT_EQ(with.joules_taken(), without.joules_taken());
}

TEST(SamplingArmWarming, MakesACollectionLongerAndDearerInTheCold) {
  const SamplerFlight cold = collected(85, true), same = collected(85, false);
  const double usual_s = integrated_s(kDrill, 100), more_s = integrated_s(kDrill, 85) - usual_s;
  EXPECT_NEAR(cold.seconds_taken() - same.seconds_taken(), more_s, 1);
  // Arm and heater for longer, and 7.5 W to hold it; the arm's waste saves its zone's heater as much as before.
  const double zone_w = 0.5 * (220 - 85) - 0.3 * 170;
  EXPECT_NEAR(cold.joules_taken() - same.joules_taken(),
              more_s * (60 + 195 + zone_w) + 7.5 * (18000 - usual_s), 600);
}

TEST(SamplingArmWarming, IsShorterWhereItIsWarmerAndLongerWhereMoreIsLost) {
  EXPECT_NEAR(collected(115, false).seconds_taken() - collected(115, true).seconds_taken(),
              integrated_s(kDrill, 100) - integrated_s(kDrill, 115), 1);
  EXPECT_NEAR(collected(100, true, 1.5).seconds_taken() - collected(100, false, 1.5).seconds_taken(),
              integrated_s(kDrill, 100, 1.5) - integrated_s(kDrill, 100), 1);
}

TEST(SamplingArmWarming, RefusesWhatWouldNeverBeWarm) {
  const SamplerFlight run = collected(85, true, 1, 55);  // 57.5 W hold it
  EXPECT_EQ(run.code(run.newest), "too-cold");
  EXPECT_EQ(run.state("lander.arm"), (temporal::State{"ready", {}}));
}

}  // namespace
}  // namespace roci::sim::components
