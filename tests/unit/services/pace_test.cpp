#include "services/clock/pace.hpp"

#include <gtest/gtest.h>

namespace roci::services::clock {
namespace {

using namespace std::chrono_literals;

const WallTime kStart{1000s};

TEST(Pace, HoldsTimeBackToItsRate) {
  Pace pace(60, kStart);
  EXPECT_EQ(pace.earliest(0s), kStart);
  EXPECT_EQ(pace.earliest(120s), kStart + 2s);
  pace.reached(120s, kStart + 2s);
  EXPECT_EQ(pace.earliest(180s), kStart + 3s);
  EXPECT_EQ(pace.time_at(kStart + 2500ms), 150s);
}

TEST(Pace, SmallDelaysDoNotAddUp) {
  Pace pace(1, kStart);
  for (int s = 1; s <= 100; ++s)
    pace.reached(std::chrono::seconds(s), kStart + std::chrono::seconds(s) + 50ms);
  EXPECT_EQ(pace.earliest(101s), kStart + 101s);
}

TEST(Pace, ARunThatFellBehindDoesNotRush) {
  Pace pace(1, kStart);
  pace.reached(1s, kStart + 10s);
  EXPECT_EQ(pace.earliest(2s), kStart + 11s);
}

TEST(Pace, ZeroIsNoLimit) {
  Pace pace(0, kStart);
  EXPECT_LE(pace.earliest(1000h), kStart);
  pace.reached(5s, kStart + 1s);
  EXPECT_EQ(pace.time_at(kStart + 100s), 5s) << "outside input comes in at the time that was reached";
}

}  // namespace
}  // namespace roci::services::clock
