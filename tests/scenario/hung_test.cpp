// Services that hang in flight (stopped, swapped out, deadlocked) instead of dying. One at a time:
// hung_matrix_test.cpp, in ./check --full.
#include <gtest/gtest.h>

#include "tests/scenario/hung_flight.hpp"

namespace roci::scenario {
namespace {

// Two go on when they have been given up, two never do; a console hangs all the while.
class HungServices : public ::testing::TestWithParam<const char*> {};

TEST_P(HungServices, AreReplacedAndNothingIsLost) {
  expect_achieved({"services", GetParam(), "planner_svc,science_svc", "pathplan_svc,arm_svc", ""});
}

class HungClock : public ::testing::TestWithParam<const char*> {};

TEST_P(HungClock, EndsTheRun) { expect_ended({"clock", GetParam(), "", "sim_svc", ""}); }

const auto kName = [](const auto& test) { return std::string(test.param); };

INSTANTIATE_TEST_SUITE_P(Transports, HungServices, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         kName);
INSTANTIATE_TEST_SUITE_P(Vendors, HungClock, ::testing::Values("fastdds", "cyclonedds"), kName);

TEST(HungPair, BothExecutivesOfAPairAtOnce) {
  expect_achieved({"pair", "mixed", "", "exec_svc", "", "--speed 500 --watchdog 4 --standby"});
}

}  // namespace
}  // namespace roci::scenario
