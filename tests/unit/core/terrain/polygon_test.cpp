#include "core/terrain/polygon.hpp"

#include <gtest/gtest.h>

namespace roci::terrain {
namespace {

const Polygon kBay{{{0, 0}, {10, 0}, {10, 10}, {5, 4}, {0, 10}}};

TEST(Polygon, ABayLiesOutside) {
  EXPECT_TRUE(contains(kBay, {2, 2}));
  EXPECT_TRUE(contains(kBay, {1, 7}));
  EXPECT_TRUE(contains(kBay, {9, 7}));
  EXPECT_FALSE(contains(kBay, {5, 7}));
  EXPECT_FALSE(contains(kBay, {-1, 5}));
  EXPECT_FALSE(contains(kBay, {11, 5}));
}

TEST(Polygon, WhereItCrossesItselfTheEvenOddRuleCounts) {
  const Polygon bow{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}};
  EXPECT_TRUE(contains(bow, {1, 5}));
  EXPECT_TRUE(contains(bow, {9, 5}));
  EXPECT_FALSE(contains(bow, {5, 9}));
}

TEST(Polygon, TheDistanceIsThatOfTheNearestPointOfTheOutline) {
  EXPECT_DOUBLE_EQ(distance_to_outline(kBay, {5, -3}), 3);
  EXPECT_DOUBLE_EQ(distance_to_outline(kBay, {13, -4}), 5);
  EXPECT_DOUBLE_EQ(distance_to_outline(kBay, {5, 4}), 0);
  EXPECT_DOUBLE_EQ(distance_to_outline(kBay, {5, 1}), 1) << "from inside, too";
  EXPECT_DOUBLE_EQ(distance_to_outline({{{1, 1}, {1, 1}, {1, 1}}}, {4, 5}), 5) << "a figure without area";
}

}  // namespace
}  // namespace roci::terrain
