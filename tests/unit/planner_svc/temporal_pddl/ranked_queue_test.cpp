#include "planner_svc/temporal_pddl/search/ranked_queue.hpp"

#include <gtest/gtest.h>

namespace roci::planner::temporal_pddl {
namespace {

using search::RankedQueue;

TEST(RankedQueue, BestFirstThenOldestOrYoungest) {
  RankedQueue<int> queue;
  queue.push({2, 0}, 1);
  queue.push({1, 5}, 2);
  for (const int item : {3, 4, 5}) queue.push({1, 4}, item);
  EXPECT_EQ(queue.oldest(), 3);
  EXPECT_EQ(queue.youngest(), 5);
  queue.drop_youngest();
  EXPECT_EQ(queue.youngest(), 4);
  for (const int expected : {3, 4, 2, 1}) {
    EXPECT_EQ(queue.oldest(), expected);
    queue.drop_oldest();
  }
  EXPECT_TRUE(queue.empty());
}

TEST(RankedQueue, LinksAreUsedAgain) {
  RankedQueue<int> queue;
  const auto fill = [&] {
    for (int i = 0; i < 100; ++i) queue.push({i % 7, 0}, i);
  };
  fill();
  const std::size_t full = queue.bytes();
  for (int i = 0; i < 100; ++i) i % 2 == 0 ? queue.drop_oldest() : queue.drop_youngest();
  EXPECT_TRUE(queue.empty());
  EXPECT_LT(queue.bytes(), full);
  fill();
  EXPECT_EQ(queue.bytes(), full);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
