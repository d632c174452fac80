#include "exec_svc/reactor/failure_tally.hpp"

#include <gtest/gtest.h>

namespace roci::exec {

using reactor::FailureTally;

namespace {

using temporal::seconds;

TEST(FailureTally, PausesDoubleFromTheSecondFailureUntilTheLimit) {
  FailureTally tally(5, seconds(30), seconds(600));
  const double pauses[] = {0, 30, 60, 120};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto count = tally.failed("arm");
    EXPECT_EQ(count.in_a_row, i + 1);
    EXPECT_EQ(count.pause, seconds(pauses[i]));
    EXPECT_FALSE(count.used_up);
  }
  const auto last = tally.failed("arm");
  EXPECT_TRUE(last.used_up);
  EXPECT_EQ(last.pause, seconds(0));
  EXPECT_EQ(tally.failed("arm").in_a_row, 1U);
}

TEST(FailureTally, ASuccessForgetsTheComponentsFailuresAndNoOthers) {
  FailureTally tally(5, seconds(30), seconds(600));
  tally.failed("arm");
  tally.failed("nav");
  tally.succeeded("arm");
  EXPECT_EQ(tally.failed("arm").in_a_row, 1U);
  EXPECT_EQ(tally.failed("nav").in_a_row, 2U);
}

TEST(FailureTally, PausesGrowUpToTheLongest) {
  FailureTally tally(1000, seconds(1), seconds(50));
  const double pauses[] = {0, 1, 2, 4, 8, 16, 32, 50, 50, 50};
  for (const double pause : pauses) EXPECT_EQ(tally.failed("arm").pause, seconds(pause));
  FailureTally::Count count;
  for (int i = 0; i < 100; ++i) count = tally.failed("arm");
  EXPECT_EQ(count.pause, seconds(50));
}

TEST(FailureTally, NoPauseIsLongerThanTheLongest) {
  FailureTally tally(5, seconds(30), seconds(20));
  tally.failed("arm");
  EXPECT_EQ(tally.failed("arm").pause, seconds(20));
}

TEST(FailureTally, ALimitOfOneGivesUpAtOnce) {
  EXPECT_TRUE(FailureTally(1, seconds(1), seconds(1)).failed("arm").used_up);
}

}  // namespace
}  // namespace roci::exec
