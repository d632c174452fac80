#include "sim_svc/world/random_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace roci::sim::world {
namespace {

TEST(RandomStream, SameSeedAndNameGiveTheSameNumbers) {
  RandomStream a(7, "drive");
  RandomStream b(7, "drive");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.normal(), b.normal());
}

TEST(RandomStream, AnotherSeedOrNameGivesOthers) {
  EXPECT_NE(RandomStream(7, "drive").uniform(), RandomStream(8, "drive").uniform());
  EXPECT_NE(RandomStream(7, "drive").uniform(), RandomStream(7, "arm").uniform());
}

TEST(RandomStream, ABranchIsAStreamOfItsOwn) {
  RandomStream stream(7, "camera");
  RandomStream untouched(7, "camera");
  const double first = stream.branch("pixels").uniform();
  EXPECT_EQ(stream.uniform(), untouched.uniform()) << "a branch draws nothing from its stream";
  EXPECT_EQ(stream.branch("pixels").uniform(), first) << "nor does the stream move its branches";
  EXPECT_NE(stream.branch("others").uniform(), first);
  EXPECT_NE(stream.branch("pixels").branch("image").uniform(), first);
}

TEST(RandomStream, UniformFillsTheUnitInterval) {
  RandomStream stream(1, "x");
  double sum = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  EXPECT_NEAR(sum / 20000, 0.5, 0.01);  // five standard errors
}

TEST(RandomStream, NormalHasTheMomentsOfAStandardNormal) {
  RandomStream stream(2, "x");
  const int n = 50000;
  double first = 0;
  double second = 0;
  double fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double z = stream.normal();
    first += z / n;
    second += z * z / n;
    fourth += z * z * z * z / n;
  }
  EXPECT_NEAR(first, 0, 0.03);
  EXPECT_NEAR(second, 1, 0.04);
  EXPECT_NEAR(fourth, 3, 0.3);
}

}  // namespace
}  // namespace roci::sim::world
