#include "core/pseudorandom/split_mix.hpp"

#include <gtest/gtest.h>

namespace roci::pseudorandom {
namespace {

// The first outputs of Vigna's reference program for the seed 1234567.
TEST(SplitMix64, IsThePublishedSequence) {
  SplitMix64 random(1234567);
  for (const std::uint64_t expected : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                       4593380528125082431U, 16408922859458223821U})
    EXPECT_EQ(random.next(), expected);
}

TEST(SplitMix64, StaysBelowItsBoundAndReachesAllOfIt) {
  SplitMix64 random(7);
  std::array<int, 5> seen{};
  for (int n = 0; n < 1000; ++n) ++seen.at(static_cast<std::size_t>(random.below(5)));
  for (const int count : seen) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace roci::pseudorandom
