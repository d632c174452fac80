#include "services/clock/restart_hold.hpp"

#include <gtest/gtest.h>

namespace roci::services::clock {
namespace {

using namespace std::chrono_literals;

constexpr WallTime kDeath{1000s};

TEST(RestartHold, HoldsFromADeathUntilTheDeadOneIsThereAgainOrTheTimeIsOver) {
  RestartHold hold(10s);
  EXPECT_FALSE(hold.holds(false, kDeath)) << "nobody died: a roster that is not complete is no death";
  hold.lost("killed", kDeath);
  EXPECT_TRUE(hold.holds(false, kDeath));
  EXPECT_TRUE(hold.holds(false, kDeath + 10s - 1us));
  EXPECT_FALSE(hold.holds(false, kDeath + 10s));
  EXPECT_FALSE(hold.holds(true, kDeath + 1s));
}

TEST(RestartHold, EachDeathCountsAnew) {
  RestartHold hold(10s);
  hold.lost("killed", kDeath);
  hold.lost("restarted", kDeath + 8s);
  EXPECT_TRUE(hold.holds(false, kDeath + 17s));
  EXPECT_FALSE(hold.holds(false, kDeath + 18s));
}

TEST(RestartHold, WhoLeavesOrHangsIsNotWaitedFor) {
  RestartHold hold(10s);
  hold.lost("left", kDeath);
  hold.lost("hung", kDeath);
  EXPECT_FALSE(hold.holds(false, kDeath));
}

}  // namespace
}  // namespace roci::services::clock
