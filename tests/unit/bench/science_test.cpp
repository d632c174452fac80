// A small piece of bench/science: seeds of the held-out range, and the same counts.
#include <gtest/gtest.h>

#include "bench/science/sheet.hpp"
#include "bench/science/trials.hpp"

namespace roci::bench::science {
namespace {

constexpr double kReach = 12;

TEST(BenchScience, FindsMoreThanChanceOnWorldsThatNobodyTunedOn) {
  std::vector<World> worlds;
  for (std::uint64_t seed = 1001; seed < 1005; ++seed) worlds.push_back(make_world(seed, 6, kReach));
  const Score score = detect(worlds, 0.6, kReach);
  Score by_chance;
  for (std::uint64_t i = 0; i < 50; ++i) by_chance.add(guess(worlds, score.goals, i));
  ASSERT_GT(score.to_find, 5);
  EXPECT_GT(score.recall(), 0.6) << score.found << " of " << score.to_find;
  EXPECT_GT(score.recall(), 1.5 * by_chance.recall());
  EXPECT_GT(score.precision(), 1.5 * by_chance.precision()) << score.right << " of " << score.goals;
}

TEST(BenchScience, CountsGoalsAndTargetsByTheirPlaces) {
  Trial trial;
  trial.odd = {{10, 10, 1, sim::world::Look::dark}, {50, 50, 1, sim::world::Look::bright}};
  trial.to_see = {trial.odd[0]};
  const Score score = score_of(trial, {{10, 12}, {50, 50}, {30, 30}});
  EXPECT_EQ(score.goals, 3);
  EXPECT_EQ(score.right, 2);
  EXPECT_EQ(score.to_find, 1);
  EXPECT_EQ(score.found, 1);
}

}  // namespace
}  // namespace roci::bench::science
