#include "core/temporal/rank_vector.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace roci::temporal {
namespace {

TEST(RankVector, AnyGainOfAHigherRankOutweighsTheLowerOnes) {
  EXPECT_LT(RankVector({0, 1000}), RankVector({1e-9}));
  EXPECT_LT(RankVector({1, 0, 5}), RankVector({1, 1e-9}));
  EXPECT_GT(RankVector({0.5, 0.2}), RankVector({0.5, 0.1, 9}));
}

TEST(RankVector, WhatIsMissingCountsAsZero) {
  EXPECT_EQ(RankVector({1, 0, 0}), RankVector({1}));
  EXPECT_EQ(RankVector({0, 0}), RankVector());
  EXPECT_GT(RankVector(), RankVector({0, -1}));
  EXPECT_EQ(RankVector({1, 2})[7], 0.0);
  EXPECT_TRUE((RankVector({1, 0}) <=> RankVector({1})) == std::partial_ordering::equivalent);
}

TEST(RankVector, AddsByRank) {
  EXPECT_EQ(RankVector({1, 2}) + RankVector({0, 0, 3}), RankVector({1, 2, 3}));
  EXPECT_EQ(RankVector({1, 2}) - RankVector({0, 2}), RankVector({1}));
  EXPECT_EQ(RankVector({1, 2}) * 0.5, RankVector({0.5, 1}));
}

// Against the definition: the first rank in which two vectors differ decides.
TEST(RankVector, OrdersAsTheDefinitionSays) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> score(-1, 1), length(0, 4);
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> a(static_cast<std::size_t>(length(random))),
        b(static_cast<std::size_t>(length(random)));
    for (double& x : a) x = score(random);
    for (double& x : b) x = score(random);
    int expected = 0;
    for (std::size_t rank = 0; rank < 4 && expected == 0; ++rank) {
      const double x = rank < a.size() ? a[rank] : 0, y = rank < b.size() ? b[rank] : 0;
      expected = x < y ? -1 : x > y ? 1 : 0;
    }
    const auto order = RankVector(a) <=> RankVector(b);
    EXPECT_EQ(order < 0, expected < 0);
    EXPECT_EQ(order > 0, expected > 0);
    EXPECT_EQ(RankVector(a) == RankVector(b), expected == 0);
  }
}

TEST(RankVector, WhatIsNoNumberHasNoOrder) {
  const RankVector odd({std::numeric_limits<double>::quiet_NaN()});
  EXPECT_FALSE(odd.finite());
  EXPECT_TRUE((odd <=> RankVector({1})) == std::partial_ordering::unordered);
  EXPECT_TRUE(RankVector({1, -2}).finite());
}

TEST(RankVector, IsANumberWhereItHasOneRank) {
  EXPECT_EQ(to_text(RankVector()), "0");
  EXPECT_EQ(to_text(RankVector({0.5})), "0.5");
  EXPECT_EQ(to_text(RankVector({1, 0, 0.25})), "[1, 0, 0.25]");
}

}  // namespace
}  // namespace roci::temporal
