// R48: the windows of a plan's time points are shortest paths of the network that comes with it.
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget;
using call::Options;
using call::WindowExtraction;
using extraction::Activity;
using extraction::Network;
using temporal::no_bound;

constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;

// By Floyd and Warshall: the greatest t(j) − t(i).
std::vector<std::vector<std::int64_t>> distances(const Network& network) {
  const std::size_t n = network.points.size();
  std::vector<std::vector<std::int64_t>> d(n, std::vector<std::int64_t>(n, kFar));
  for (std::size_t i = 0; i < n; ++i) d[i][i] = 0;
  for (const auto& c : network.constraints) {
    if (c.upper != no_bound)
      d[c.from_point][c.to_point] = std::min(d[c.from_point][c.to_point], c.upper.count());
    d[c.to_point][c.from_point] = std::min(d[c.to_point][c.from_point], -c.lower.count());
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (d[i][k] < kFar && d[k][j] < kFar) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
      }
    }
  }
  return d;
}

TEST(Network, WindowsAreShortestPaths) {
  std::mt19937_64 random(11);
  Budget budget;
  budget.evaluations = 500;
  std::size_t points = 0, bounded = 0;
  for (int round = 0; round < 400; ++round) {
    const auto model = testing::random_task(random);
    Options options;
    options.windows = round % 2 == 0 ? WindowExtraction::recurring : WindowExtraction::none;
    const Result result = testing::solved(model, options, budget);
    if (!result.plan) continue;
    const Network& network = result.plan->network;
    const auto d = distances(network);
    for (std::size_t i = 0; i < network.points.size(); ++i) {
      EXPECT_EQ(network.points[i].earliest.count(), -d[i][0]);
      EXPECT_EQ(network.points[i].latest.count(), d[0][i] == kFar ? no_bound.count() : d[0][i]);
      bounded += d[0][i] < kFar;
    }
    points += network.points.size();
    for (std::size_t a = 0; a < result.plan->activities.size(); ++a) {
      const Activity& activity = result.plan->activities[a];
      EXPECT_EQ(network.points[activity.start_point].activity, a);
      EXPECT_EQ(network.points[activity.start_point].earliest, activity.start);
      EXPECT_EQ(network.points[activity.end_point].earliest, activity.end);
      EXPECT_GE(activity.end - activity.start, activity.min_duration);
      EXPECT_LE(activity.end - activity.start, activity.max_duration);
    }
  }
  EXPECT_GT(points, 200u);
  EXPECT_GT(bounded, points / 10);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
