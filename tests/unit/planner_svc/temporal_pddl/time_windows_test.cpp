#include "planner_svc/temporal_pddl/task/time_windows.hpp"

#include <gtest/gtest.h>

#include <random>

namespace roci::planner::temporal_pddl {
namespace {

using task::intersection;
using task::shrunk;
using task::window_from;
using task::TimeWindow;
using task::TimeWindows;
using temporal::Duration;
using temporal::no_bound;

bool contains(const TimeWindows& windows, Duration time) {
  for (const auto& window : windows) {
    if (window.open <= time && time <= window.close) return true;
  }
  return false;
}

TimeWindows random_windows(std::mt19937_64& random) {
  TimeWindows result;
  std::int64_t at = static_cast<std::int64_t>(random() % 5);
  for (std::size_t n = random() % 5; n > 0; --n) {
    const auto close = at + static_cast<std::int64_t>(random() % 6);
    result.push_back({Duration(at), n == 1 && random() % 2 == 0 ? no_bound : Duration(close)});
    at = close + 1 + static_cast<std::int64_t>(random() % 4);
  }
  return result;
}

TEST(TimeWindows, IntersectionAndShrinkingPointByPoint) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 1000; ++round) {
    const TimeWindows a = random_windows(random);
    const TimeWindows b = random_windows(random);
    const TimeWindows both = intersection(a, b);
    for (std::int64_t t = 0; t < 60; ++t) {
      EXPECT_EQ(contains(both, Duration(t)), contains(a, Duration(t)) && contains(b, Duration(t)));
      const TimeWindow* next = window_from(a, Duration(t));
      for (const auto& window : a) {
        if (window.close < Duration(t)) continue;
        ASSERT_TRUE(next);
        EXPECT_EQ(*next, window);
        break;
      }
    }
    for (const auto& window : shrunk(a, Duration{1}, Duration{2})) {
      EXPECT_TRUE(window.open == Duration{0} || contains(a, window.open - Duration{1}));
      EXPECT_TRUE(window.close == no_bound || contains(a, window.close + Duration{2}));
    }
  }
}

TEST(TimeWindows, ShrinkingDropsWhatBecomesEmpty) {
  const TimeWindows windows{{Duration{0}, Duration{3}}, {Duration{5}, Duration{6}}, {Duration{10}, no_bound}};
  EXPECT_EQ(shrunk(windows, Duration{1}, Duration{1}),
            (TimeWindows{{Duration{0}, Duration{2}}, {Duration{11}, no_bound}}));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
