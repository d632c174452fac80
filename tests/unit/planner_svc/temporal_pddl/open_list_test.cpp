#include "planner_svc/temporal_pddl/search/open_list.hpp"

#include <gtest/gtest.h>

namespace roci::planner::temporal_pddl {
namespace {

OpenEntry entry(std::size_t n) { return {NodeId(n), SnapId(n)}; }

constexpr Priority kAny{0, 0};

TEST(OpenQueue, BestFirstThenOldest) {
  OpenQueue queue(OpenQueue::Order::oldest);
  queue.push({2, 0}, entry(1));
  queue.push({1, 5}, entry(2));
  queue.push({1, 4}, entry(3));
  queue.push({1, 4}, entry(4));
  EXPECT_EQ(queue.size(), 4u);
  for (const std::size_t expected : {3u, 4u, 2u, 1u}) EXPECT_EQ(queue.pop().parent, NodeId(expected));
  EXPECT_TRUE(queue.empty());
}

TEST(OpenQueue, StreaksOfYoungestAndOldest) {
  OpenQueue queue(OpenQueue::Order::streaks);
  for (std::size_t i = 0; i < 1000; ++i) queue.push({1, 4}, entry(i));
  queue.push({1, 3}, entry(5000));
  EXPECT_EQ(queue.pop().parent, NodeId(std::size_t{5000}));
  std::size_t youngest = 0;
  std::size_t low = 0;
  std::size_t high = 999;
  for (int i = 0; i < 640; ++i) {
    const NodeId next = queue.pop().parent;
    ASSERT_TRUE(next == NodeId(low) || next == NodeId(high));
    youngest += next == NodeId(high);
    next == NodeId(high) ? --high : ++low;
  }
  EXPECT_NEAR(static_cast<double>(youngest), 320, 2);
}

TEST(OpenList, InOneQueueEachComesOnce) {
  OpenList open(OpenList::Sharing::one_queue);
  for (std::size_t i = 0; i < 10; ++i) open.push({1, 0}, kAny, i % 3 == 0, entry(i));
  std::size_t count = 0;
  while (open.pop()) ++count;
  EXPECT_EQ(count, 10u);
}

TEST(OpenList, PreferredTakeTurnsAndGoFirstAfterProgress) {
  OpenList open(OpenList::Sharing::one_queue);
  for (std::size_t i = 0; i < 10; ++i) {
    open.push({1, 0}, kAny, true, entry(100 + i));
    open.push({1, 0}, kAny, false, entry(i));
  }
  std::size_t preferred = 0;
  for (int i = 0; i < 10; ++i) preferred += open.pop()->parent.value >= 100;
  EXPECT_EQ(preferred, 5u);
  open.boost();
  for (int i = 0; i < 5; ++i) EXPECT_GE(open.pop()->parent.value, 100u);
  for (int i = 0; i < 5; ++i) EXPECT_LT(open.pop()->parent.value, 100u);
}

TEST(OpenList, TheBestByPlanAndTheBestByLandmarksTakeTurns) {
  OpenList open(OpenList::Sharing::all_queues);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto rank = static_cast<std::int64_t>(i);
    open.push({rank, 0}, {10 - rank, 0}, false, entry(i));
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(open.pop()->parent, NodeId(i));
    EXPECT_EQ(open.pop()->parent, NodeId(9 - i));
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
