// Worlds as large as a mission: many blocks, times in hours and starts that lie on no grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

constexpr TaskId kCandidate = ~TaskId{0};

std::vector<Definition> lander() {
  return {{.name = "arm", .kind = Kind::atomic},
          {.name = "phase", .kind = Kind::state, .states = {"a", "b", "c"}},
          {.name = "power", .kind = Kind::claimable, .highest = 300},
          {.name = "stored", .kind = Kind::cumulative, .initial = 500, .lowest = 0, .highest = 2000},
          {.name = "battery", .kind = Kind::cumulative_rate, .initial = 2e6, .lowest = 0}};
}

struct Mission {
  explicit Mission(std::uint64_t seed, int tasks)
      : random(seed), lines(lander(), Extent{.end = seconds(2e6)}) {
    for (int i = 0; i < tasks; ++i) {
      const Footprint footprint = draw();
      const Time start{std::uniform_int_distribution<std::int64_t>(0, 1'900'000'000'000)(random)};
      lines.place(static_cast<TaskId>(i), footprint, start);
    }
  }
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  bool chance(double share) { return number(0, 1) < share; }
  Footprint draw() {
    Footprint footprint{seconds(number(1, 4000)), {}, {}};
    const auto edge = [&] { return chance(0.5) ? ImpactWhen::at_start : ImpactWhen::at_end; };
    if (chance(0.1)) footprint.impacts.push_back({0, ImpactKind::delta, ImpactWhen::during, 1});
    if (chance(0.05))
      footprint.impacts.push_back({1, ImpactKind::assign, edge(), static_cast<double>(random() % 3)});
    if (chance(0.3)) footprint.impacts.push_back({2, ImpactKind::delta, ImpactWhen::during, number(0, 120)});
    if (chance(0.3)) footprint.impacts.push_back({3, ImpactKind::delta, edge(), number(-60, 60)});
    if (chance(0.02)) footprint.impacts.push_back({3, ImpactKind::assign, edge(), number(100, 900)});
    if (chance(0.5)) footprint.impacts.push_back({4, ImpactKind::rate, ImpactWhen::during, -number(0, 5)});
    if (chance(0.02)) footprint.impacts.push_back({4, ImpactKind::rate, edge(), number(-0.05, 0.05)});
    const auto phase = [&] { return static_cast<Phase>(random() % 3); };
    if (chance(0.1))
      footprint.constraints.push_back({.timeline = 1, .phase = phase(), .states = 1 + random() % 6});
    if (chance(0.2))
      footprint.constraints.push_back({.timeline = 3, .phase = phase(), .lowest = number(0, 300)});
    if (chance(0.2))
      footprint.constraints.push_back({.timeline = 4, .phase = phase(), .lowest = number(0, 8e5)});
    return footprint;
  }
  std::mt19937_64 random;
  Timelines lines;
};

/// Returns whether every conflict of `with` lies within conflicts of `without`, of the same bounds.
bool within(const std::vector<Conflict>& with, const std::vector<Conflict>& without) {
  return std::ranges::all_of(with, [&](const Conflict& it) {
    return std::ranges::any_of(without, [&](const Conflict& old) {
      return std::tie(old.timeline, old.task, old.constraint) ==
                 std::tie(it.timeline, it.task, it.constraint) &&
             old.from <= it.from && it.to <= old.to;
    });
  });
}

/// Returns whether a conflict begins or ends at that instant. Then the candidate may break another side of an instant
/// that is in conflict anyway, which stretches of time do not tell.
bool at_edge(const std::vector<Conflict>& conflicts, Time time) {
  return std::ranges::any_of(conflicts, [&](const Conflict& it) { return it.from == time || it.to == time; });
}

TEST(LargeTimelines, StartsAreValidWhereAPlacementMakesNoNewConflict) {
  int valid = 0;
  int invalid = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Mission mission(seed, 400);
    const auto before = mission.lines.conflicts(Time{0}, kLastTime);
    for (int i = 0; i < 12; ++i) {
      const Footprint footprint = mission.draw();
      const Interval all{Time{0}, seconds(2e6)};
      const auto intervals = mission.lines.valid_starts(footprint, all);
      std::set<Time> starts;  // beside every edge, and anywhere
      for (const Interval& interval : intervals)
        for (const Time edge : {interval.earliest, interval.latest})
          for (const int step : {-1, 0, 1}) starts.insert(edge + Duration{step});
      while (starts.size() > 30)
        starts.erase(std::next(starts.begin(), static_cast<int>(mission.random() % starts.size())));
      for (int k = 0; k < 10; ++k) starts.insert(Time{static_cast<std::int64_t>(mission.number(0, 2e12))});
      for (const Time start : starts) {
        if (start < Time{0} || start + footprint.duration > seconds(2e6)) continue;
        const bool inside = std::ranges::any_of(
            intervals, [&](const Interval& it) { return it.earliest <= start && start <= it.latest; });
        const std::size_t mark = mission.lines.mark();
        mission.lines.place(kCandidate, footprint, start);
        const auto after = mission.lines.conflicts(Time{0}, kLastTime);
        mission.lines.undo(mark);
        const bool fine = within(after, before);
        if (fine && !inside && (at_edge(before, start) || at_edge(before, start + footprint.duration)))
          continue;
        EXPECT_EQ(inside, fine) << "seed " << seed << ", task " << i << " at " << start.count();
        ++(inside ? valid : invalid);
      }
      EXPECT_EQ(mission.lines.first_valid_start(footprint, all),
                intervals.empty() ? std::nullopt : std::optional(intervals.front().earliest));
    }
    EXPECT_EQ(mission.lines.conflicts(Time{0}, kLastTime), before);
  }
  EXPECT_GT(valid, 200);
  EXPECT_GT(invalid, 200);
}

TEST(LargeTimelines, BlocksOfEverySizeSayTheSame) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Mission mission(seed, 300);
    std::vector<Timelines> others;
    for (const std::size_t block : {1U, 7U, 100'000U}) {
      Mission same(seed, 0);
      same.lines = Timelines(lander(), Extent{.end = seconds(2e6), .block = block});
      for (int i = 0; i < 300; ++i) {
        const Footprint footprint = same.draw();
        same.lines.place(
            static_cast<TaskId>(i), footprint,
            Time{std::uniform_int_distribution<std::int64_t>(0, 1'900'000'000'000)(same.random)});
      }
      others.push_back(std::move(same.lines));
    }
    const Interval all{Time{0}, seconds(2e6)};
    for (int i = 0; i < 30; ++i) {
      const Footprint footprint = mission.draw();
      const auto expected = mission.lines.valid_starts(footprint, all);
      const Time at{static_cast<std::int64_t>(mission.number(0, 2e12))};
      const auto moved = static_cast<TaskId>(mission.random() % 300);
      const Time later = at + seconds(mission.number(0, 5000));
      for (Timelines& other : others) {
        ASSERT_EQ(other.valid_starts(footprint, all), expected);
        for (Index line = 0; line < 5; ++line)
          ASSERT_EQ(other.value(line, at), mission.lines.value(line, at));
        ASSERT_EQ(other.conflicts(at, later), mission.lines.conflicts(at, later));
        other.move(moved, at, later);
      }
      mission.lines.move(moved, at, later);
    }
  }
}

}  // namespace
}  // namespace roci::temporal::timelines
