#include "bench/europa/task_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace roci::bench::europa {
namespace {

TEST(TaskWorld, AFateDependsOnSeedTaskAndExecutionAlone) {
  const TaskWorld world{.seed = 7};
  const Fate once = fate(world, "collect_0_1", 3);
  for (int other = 0; other < 10; ++other) fate(world, "excavate_0", static_cast<std::uint32_t>(other));
  const Fate again = fate(world, "collect_0_1", 3);
  EXPECT_EQ(once.energy, again.energy);
  EXPECT_EQ(once.failure, again.failure);
  EXPECT_NE(once.energy, fate(world, "collect_0_1", 4).energy);
  EXPECT_NE(once.energy, fate(world, "collect_0_2", 3).energy);
  EXPECT_NE(once.energy, fate({.seed = 8}, "collect_0_1", 3).energy);
}

TEST(TaskWorld, ABiasChangesTheMeanAndNothingElse) {
  const Fate fair = fate({.seed = 7}, "downlink", 0);
  const Fate dear = fate({.seed = 7, .bias = 0.1}, "downlink", 0);
  EXPECT_NEAR(dear.energy, fair.energy + 0.1, 1e-12);
  EXPECT_EQ(dear.failure, fair.failure);
}

// All within 4 standard errors of what is promised.
TEST(TaskWorld, EnergyAndFailuresHaveTheirShares) {
  constexpr int kDraws = 40'000;
  const TaskWorld world{.seed = 1, .bias = -0.1};
  double sum = 0;
  double squares = 0;
  std::array<int, 4> failures{};
  double dear_failures = 0;
  for (int n = 0; n < kDraws; ++n) {
    const Fate here = fate(world, "task" + std::to_string(n % 40), static_cast<std::uint32_t>(n / 40));
    sum += here.energy;
    squares += here.energy * here.energy;
    ++failures[static_cast<std::size_t>(here.failure)];
    dear_failures += here.failure != Resolution::none && here.energy > 0.9 ? 1 : 0;
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 0.9, 4 * 0.1 / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(squares / kDraws - mean * mean), 0.1, 0.002);
  const std::array<double, 4> expected{0.9, 0.03, 0.042, 0.028};
  for (std::size_t kind = 0; kind < 4; ++kind) {
    const double error = std::sqrt(expected[kind] * (1 - expected[kind]) / kDraws);
    EXPECT_NEAR(failures[kind] / static_cast<double>(kDraws), expected[kind], 4 * error) << kind;
  }
  // A failure says nothing about the energy.
  const double failed = kDraws - failures[0];
  EXPECT_NEAR(dear_failures / failed, 0.5, 4 * 0.5 / std::sqrt(failed));
}

}  // namespace
}  // namespace roci::bench::europa
