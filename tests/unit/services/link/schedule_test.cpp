#include "services/link/schedule.hpp"

#include <gtest/gtest.h>

#include <random>

namespace roci::services::link {
namespace {

using namespace std::chrono_literals;
using temporal::Time;

TEST(Schedule, WithoutWindowsItIsOpenButForItsCuts) {
  EXPECT_TRUE(Schedule().open(-5s));
  EXPECT_EQ(Schedule().closes(0s), temporal::no_bound);
  const Schedule cut({}, {{10s, 20s}});
  EXPECT_TRUE(cut.open(10s - 1us));
  EXPECT_FALSE(cut.open(10s));
  EXPECT_TRUE(cut.open(20s));
  EXPECT_EQ(cut.closes(3s), 10s);
  EXPECT_EQ(cut.next_open(15s), 20s);
}

TEST(Schedule, AfterTheLastWindowItStaysClosed) {
  const Schedule schedule({{10s, 20s}}, {{18s, 30s}});
  EXPECT_EQ(schedule.next_open(0s), 10s);
  EXPECT_EQ(schedule.closes(12s), 18s);
  EXPECT_EQ(schedule.next_open(18s), std::nullopt);
}

// In order and apart, from 0 to 100 s.
std::vector<Interval> intervals(std::mt19937& random) {
  std::vector<Interval> out;
  for (Time at{0}; at < 100s;) {
    const Time from = at + std::chrono::seconds(random() % 20);
    const Time to = from + std::chrono::seconds(1 + random() % 20);
    out.emplace_back(from, to);
    at = to;
  }
  return out;
}

bool in_one(const std::vector<Interval>& intervals, Time time) {
  for (const Interval& interval : intervals)
    if (interval.first <= time && time < interval.second) return true;
  return false;
}

TEST(Schedule, IsOpenInItsWindowsWithoutItsCuts) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const auto windows = intervals(random);
    const auto cuts = intervals(random);
    const Schedule schedule(windows, cuts);
    std::optional<Time> next;
    Time closes{160s};
    for (Time time{160s}; time >= 0s; time -= 1s) {
      const bool open = in_one(windows, time) && !in_one(cuts, time);
      ASSERT_EQ(schedule.open(time), open) << round << " " << time.count();
      if (open) next = time;
      if (!open) closes = time;
      EXPECT_EQ(schedule.next_open(time), next);
      EXPECT_EQ(schedule.closes(time), open ? closes : time);
    }
  }
}

}  // namespace
}  // namespace roci::services::link
