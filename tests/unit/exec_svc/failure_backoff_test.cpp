#include "exec_svc/reactor/failure_backoff.hpp"

#include <gtest/gtest.h>

namespace roci::exec {

using reactor::FailureBackoff;

namespace {

using temporal::seconds;

TEST(FailureBackoff, PausesDoubleFromTheSecondFailureUntilTheLimit) {
  FailureBackoff backoff(5, seconds(30), seconds(600));
  const double pauses[] = {0, 30, 60, 120};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto count = backoff.failed("arm");
    EXPECT_EQ(count.in_a_row, i + 1);
    EXPECT_EQ(count.pause, seconds(pauses[i]));
    EXPECT_FALSE(count.used_up);
  }
  const auto last = backoff.failed("arm");
  EXPECT_TRUE(last.used_up);
  EXPECT_EQ(last.pause, seconds(0));
  EXPECT_EQ(backoff.failed("arm").in_a_row, 1U);
}

TEST(FailureBackoff, ASuccessForgetsTheComponentsFailuresAndNoOthers) {
  FailureBackoff backoff(5, seconds(30), seconds(600));
  backoff.failed("arm");
  backoff.failed("nav");
  backoff.succeeded("arm");
  EXPECT_EQ(backoff.failed("arm").in_a_row, 1U);
  EXPECT_EQ(backoff.failed("nav").in_a_row, 2U);
}

TEST(FailureBackoff, PausesGrowUpToTheLongest) {
  FailureBackoff backoff(1000, seconds(1), seconds(50));
  const double pauses[] = {0, 1, 2, 4, 8, 16, 32, 50, 50, 50};
  for (const double pause : pauses) EXPECT_EQ(backoff.failed("arm").pause, seconds(pause));
  FailureBackoff::Count count;
  for (int i = 0; i < 100; ++i) count = backoff.failed("arm");
  EXPECT_EQ(count.pause, seconds(50));
}

TEST(FailureBackoff, NoPauseIsLongerThanTheLongest) {
  FailureBackoff backoff(5, seconds(30), seconds(20));
  backoff.failed("arm");
  EXPECT_EQ(backoff.failed("arm").pause, seconds(20));
}

TEST(FailureBackoff, ALimitOfOneGivesUpAtOnce) {
  EXPECT_TRUE(FailureBackoff(1, seconds(1), seconds(1)).failed("arm").used_up);
}

}  // namespace
}  // namespace roci::exec
