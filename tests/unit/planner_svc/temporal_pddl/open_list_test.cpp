#include "planner_svc/temporal_pddl/search/open_list.hpp"

#include <gtest/gtest.h>

namespace roci::planner::temporal_pddl {
namespace {

OpenEntry entry(std::size_t n) { return {NodeId(n), SnapId(n)}; }

TEST(OpenList, BestFirstThenOldest) {
  OpenList open;
  open.push({2, 0}, false, entry(1));
  open.push({1, 5}, false, entry(2));
  open.push({1, 4}, false, entry(3));
  open.push({1, 4}, false, entry(4));
  EXPECT_EQ(open.size(), 4u);
  for (const std::size_t expected : {3u, 4u, 2u, 1u}) EXPECT_EQ(open.pop()->parent, NodeId(expected));
  EXPECT_FALSE(open.pop());
}

TEST(OpenList, PreferredComeInStreaksOfYoungestAndOldest) {
  OpenList open;
  for (std::size_t i = 0; i < 1000; ++i) open.push({1, 4}, true, entry(i));
  open.push({1, 3}, true, entry(5000));
  EXPECT_EQ(open.pop()->parent, NodeId(std::size_t{5000}));
  std::size_t youngest = 0;
  std::size_t low = 0;
  std::size_t high = 999;
  for (int i = 0; i < 640; ++i) {
    const NodeId next = open.pop()->parent;
    ASSERT_TRUE(next == NodeId(low) || next == NodeId(high));
    youngest += next == NodeId(high);
    next == NodeId(high) ? --high : ++low;
  }
  EXPECT_NEAR(static_cast<double>(youngest), 320, 2);
}

TEST(OpenList, PreferredTakeTurnsAndGoFirstAfterProgress) {
  OpenList open;
  for (std::size_t i = 0; i < 10; ++i) {
    open.push({1, 0}, true, entry(100 + i));
    open.push({1, 0}, false, entry(i));
  }
  std::size_t preferred = 0;
  for (int i = 0; i < 10; ++i) preferred += open.pop()->parent.value >= 100;
  EXPECT_EQ(preferred, 5u);
  open.boost();
  for (int i = 0; i < 5; ++i) EXPECT_GE(open.pop()->parent.value, 100u);
  for (int i = 0; i < 5; ++i) EXPECT_LT(open.pop()->parent.value, 100u);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
