#include "core/temporal/stn.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/temporal/schedule.hpp"
#include "tests/unit/core/temporal/floyd_warshall.hpp"

namespace roci::temporal {
namespace {

TEST(Stn, WindowsOfAChain) {
  Stn stn(4);
  ASSERT_TRUE(stn.add(0, 1, Duration{10}, Duration{20}));
  ASSERT_TRUE(stn.add(1, 2, Duration{5}));
  ASSERT_TRUE(stn.add(0, 2, Duration{0}, Duration{22}));
  EXPECT_EQ(stn.window(1), (Window{Duration{10}, Duration{17}}));
  EXPECT_EQ(stn.window(2), (Window{Duration{15}, Duration{22}}));
  EXPECT_EQ(stn.window(3), (Window{-no_bound, no_bound}));
  EXPECT_EQ(stn.window(0), (Window{Duration{0}, Duration{0}}));
}

TEST(Stn, RefusesANegativeCycleAndStaysAsItWas) {
  Stn stn(4);
  ASSERT_TRUE(stn.add(1, 2, Duration{10}, Duration{12}));
  ASSERT_TRUE(stn.add(2, 3, Duration{10}, Duration{12}));
  EXPECT_FALSE(stn.add(1, 3, Duration{0}, Duration{19}));  // far from the origin: no window shows it
  EXPECT_FALSE(stn.add(1, 1, Duration{1}));
  EXPECT_FALSE(stn.add(0, 1, Duration{2}, Duration{1}));
  EXPECT_TRUE(stn.add(1, 3, Duration{0}, Duration{20}));
  EXPECT_TRUE(stn.add(0, 1, Duration{0}, Duration{0}));
  EXPECT_EQ(stn.window(3), (Window{Duration{20}, Duration{20}}));
}

TEST(Stn, GrowsByPointsAndIsRestoredFromACopy) {
  Stn stn;
  const TimePoint a = stn.add_point();
  ASSERT_TRUE(stn.add(origin_point, a, Duration{3}, Duration{9}));
  const Stn checkpoint = stn;
  ASSERT_TRUE(stn.add(origin_point, a, Duration{5}));
  EXPECT_EQ(stn.window(a).lower, Duration{5});
  stn = checkpoint;
  EXPECT_EQ(stn.window(a), (Window{Duration{3}, Duration{9}}));
}

TEST(ScheduleProperty, IsTheEarliestOfAllOrThereIsNone) {
  std::mt19937_64 random(12);
  int inconsistent = 0;
  for (int run = 0; run < 8000; ++run) {
    const std::size_t n = 2 + random() % 9;
    std::vector<TemporalConstraint> constraints;
    FloydWarshall oracle(n);
    bool consistent = true;
    const auto add = [&](const TemporalConstraint& c) {
      constraints.push_back(c);
      consistent = consistent && oracle.add(c.from_point, c.to_point, c.lower, c.upper);
    };
    for (TimePoint p = 1; p < n; ++p) add({0, p, ConstraintKind::window, Duration{0}, no_bound});
    for (std::uint64_t c = random() % (2 * n); c > 0; --c) {
      const Duration lower{static_cast<int>(random() % 40) - 10};
      const Duration upper = random() % 2 ? no_bound : lower + Duration{static_cast<int>(random() % 20)};
      const auto from = static_cast<TimePoint>(random() % n);
      const auto to = static_cast<TimePoint>(random() % n);
      if (from != to) add({from, to, ConstraintKind::ordering, lower, upper});
    }
    const auto schedule = earliest_schedule(n, constraints);
    ASSERT_EQ(schedule.has_value(), consistent) << "run " << run;
    inconsistent += consistent ? 0 : 1;
    for (TimePoint p = 0; consistent && p < n; ++p)
      ASSERT_EQ((*schedule)[p], oracle.window(p).lower) << "run " << run;
  }
  EXPECT_GT(inconsistent, 1000);
}

TEST(StnProperty, AgreesWithFloydWarshallAfterEveryConstraint) {
  std::mt19937_64 random(11);
  int refused = 0;
  for (int run = 0; run < 4000; ++run) {
    const std::size_t n = 2 + random() % 9;
    Stn stn(n);
    FloydWarshall oracle(n);
    for (std::uint64_t c = random() % (4 * n); c > 0; --c) {
      const auto from = static_cast<TimePoint>(random() % n);
      const auto to = static_cast<TimePoint>(random() % n);
      if (from == to) continue;
      const Duration lower = random() % 8 == 0 ? -no_bound : Duration{static_cast<int>(random() % 40) - 15};
      const Duration width{static_cast<int>(random() % 20)};
      const Duration upper = random() % 3 == 0 || lower == -no_bound ? no_bound : lower + width;
      const bool accepted = stn.add(from, to, lower, upper);
      ASSERT_EQ(accepted, oracle.add(from, to, lower, upper)) << "run " << run;
      refused += accepted ? 0 : 1;
      for (TimePoint p = 0; p < n; ++p)
        ASSERT_EQ(stn.window(p), oracle.window(p)) << "run " << run << " point " << p;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace roci::temporal
