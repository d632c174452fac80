#include "planner_svc/temporal_pddl/heuristics/bucket_queue.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace roci::planner::temporal_pddl {
namespace {

using heuristics::BucketQueue;
using heuristics::PropositionId;

// Dijkstra's use of it: what is pushed costs no less than what was taken last.
TEST(BucketQueue, CheapestFirstThenOldest) {
  std::mt19937_64 random(3);
  BucketQueue queue;
  for (int round = 0; round < 50; ++round) {
    std::multimap<std::int64_t, std::uint32_t> expected;  // equal keys in order of insertion
    std::int64_t last = 0;
    for (std::uint32_t i = 0; i < 300 || !expected.empty(); ++i) {
      if (i < 300 && (expected.empty() || random() % 2 == 0)) {
        const std::int64_t cost = last + static_cast<std::int64_t>(random() % (round % 2 == 0 ? 20 : 400));
        queue.push(cost, PropositionId(i));
        expected.emplace(cost, i);
      } else {
        ASSERT_FALSE(queue.empty());
        const auto [cost, proposition] = queue.pop();
        last = cost;
        ASSERT_EQ(cost, expected.begin()->first);
        if (cost < 1024) {
          EXPECT_EQ(proposition.value, expected.begin()->second);
        }
        const auto [begin, end] = expected.equal_range(cost);
        const auto place =
            std::find_if(begin, end, [&](const auto& e) { return e.second == proposition.value; });
        ASSERT_NE(place, end);
        expected.erase(place);
      }
    }
    EXPECT_TRUE(queue.empty());
    queue.restart();
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
