#include <gtest/gtest.h>

#include "tests/unit/planner_svc/utility_htn/downlink/brute_force.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

TEST(ManyQuestions, ThousandsAreAnsweredAsByBruteForce) {
  std::mt19937_64 random(2);
  Manager manager;
  for (int round = 0; round < 8'000; ++round) {
    const RandomQuestion question = draw(random, round % 2 == 0);
    ASSERT_EQ(fault(question, manager.assign(question.products, question.windows, question.limits)), "")
        << "round " << round;
  }
  EXPECT_EQ(manager.counts().open, 0u);
}

}  // namespace
}  // namespace roci::planner::utility_htn::downlink
