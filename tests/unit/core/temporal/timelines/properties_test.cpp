// Timelines against an oracle that sweeps small random worlds microsecond by microsecond.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/temporal/timelines/oracle.hpp"

namespace roci::temporal::timelines {
namespace {

using oracle::Draw;
using oracle::kEnd;
using oracle::Placed;
using oracle::World;

constexpr int kWorlds = 2000;
constexpr Interval kAll{Time{0}, Time{kEnd}};

/// Is a random world and the timelines that should hold the same.
struct Pair {
  explicit Pair(std::uint64_t seed)
      : draw(seed),
        world{draw.definitions(), {}, {}},
        lines(world.definitions,
              Extent{.end = Time{kEnd}, .block = static_cast<std::size_t>(draw.between(1, 8))}) {
    const int tasks = draw.between(0, 8);
    for (int i = 0; i < tasks; ++i) place();
    while (draw.chance(30)) observe(0);
  }
  void place() {
    const TaskId id = static_cast<TaskId>(draw.between(1, 1'000'000));
    if (world.tasks.contains(id)) return;
    const Footprint footprint = draw.footprint(world.definitions, 12);
    const std::int64_t start = draw.between(0, static_cast<int>(kEnd - footprint.duration.count()));
    world.tasks[id] = {footprint, start, start + footprint.duration.count()};
    lines.place(id, footprint, Time{start});
  }
  void observe(int from) {
    const auto line = static_cast<Index>(draw.between(0, static_cast<int>(world.definitions.size()) - 1));
    const int time = draw.between(from, kEnd);
    const double value = draw.observed(world.definitions[line]);
    world.observations[{line, time}] = value;
    lines.observe(line, Time{time}, value);
  }
  TaskId any_task() {
    auto task = world.tasks.begin();
    std::advance(task, draw.between(0, static_cast<int>(world.tasks.size()) - 1));
    return task->first;
  }
  void move() {
    if (world.tasks.empty()) return;
    const TaskId id = any_task();
    Placed& task = world.tasks[id];
    task.start = draw.between(0, kEnd);
    task.end = draw.between(static_cast<int>(task.start), kEnd);
    lines.move(id, Time{task.start}, Time{task.end});
  }
  void remove() {
    if (world.tasks.empty()) return;
    const TaskId id = any_task();
    world.tasks.erase(id);
    lines.remove(id);
  }
  void change() {
    const int what = draw.between(1, 3);
    if (what == 1) place();
    if (what == 2) move();
    if (what == 3) remove();
  }

  Draw draw;
  World world;
  Timelines lines;
};

void expect_values(const World& world, const Timelines& lines, std::int64_t from = 0) {
  for (Index line = 0; line < world.definitions.size(); ++line) {
    const auto expected = world.values(line);
    for (std::int64_t t = from; t <= kEnd; ++t)
      for (const Side side : {Side::before, Side::between, Side::after})
        ASSERT_EQ(
            lines.value(line, Time{t}, side),
            static_cast<double>(expected[static_cast<std::size_t>(t)][static_cast<std::size_t>(side)]) / 1e6)
            << "timeline " << line << " at " << t << ", side " << static_cast<int>(side);
  }
}

TEST(TimelineProperties, ValuesAreThoseOfASweepOverAllMicroseconds) {
  for (int seed = 0; seed < kWorlds && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const Pair pair(static_cast<std::uint64_t>(seed));
    expect_values(pair.world, pair.lines);
  }
}

TEST(TimelineProperties, ConflictsAreThoseOfASweepOverAllMicroseconds) {
  for (int seed = 0; seed < kWorlds && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Pair pair(static_cast<std::uint64_t>(seed));
    const Time from{pair.draw.between(0, kEnd)};
    const Time to{pair.draw.between(static_cast<int>(from.count()), kEnd)};
    ASSERT_EQ(pair.lines.conflicts(Time{0}, Time{kEnd}), pair.world.conflicts(Time{0}, Time{kEnd}));
    ASSERT_EQ(pair.lines.conflicts(from, to), pair.world.conflicts(from, to));
  }
}

std::vector<Interval> common(const std::vector<Interval>& intervals, Interval window) {
  std::vector<Interval> all;
  for (const Interval& it : intervals) {
    const Interval part{std::max(it.earliest, window.earliest), std::min(it.latest, window.latest)};
    if (part.earliest <= part.latest) all.push_back(part);
  }
  return all;
}

TEST(TimelineProperties, ValidStartsAreThoseOfTryingEveryMicrosecond) {
  int some = 0;
  for (int seed = 0; seed < kWorlds && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Pair pair(static_cast<std::uint64_t>(seed));
    const Footprint footprint = pair.draw.footprint(pair.world.definitions, 12);
    const auto valid = pair.lines.valid_starts(footprint, kAll);
    ASSERT_EQ(valid, pair.world.valid_starts(footprint, kAll));
    const Time from{pair.draw.between(0, kEnd)};
    const Interval window{from, Time{pair.draw.between(static_cast<int>(from.count()), kEnd)}};
    const auto within = common(valid, window);
    ASSERT_EQ(pair.lines.valid_starts(footprint, window), within);
    ASSERT_EQ(pair.lines.first_valid_start(footprint, window),
              within.empty() ? std::nullopt : std::optional(within.front().earliest));
    if (!valid.empty() && valid != std::vector<Interval>{{Time{0}, Time{kEnd} - footprint.duration}}) ++some;
  }
  EXPECT_GT(some, kWorlds / 5) << "worlds in which some starts are valid and others not";
}

TEST(TimelineProperties, MovesRemovalsAndObservationsActAsInASweep) {
  for (int seed = 0; seed < kWorlds / 3 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Pair pair(static_cast<std::uint64_t>(seed));
    for (int step = 0; step < 12; ++step) {
      pair.change();
      if (pair.draw.chance(20)) pair.observe(0);
    }
    expect_values(pair.world, pair.lines);
    ASSERT_EQ(pair.lines.conflicts(Time{0}, Time{kEnd}), pair.world.conflicts(Time{0}, Time{kEnd}));
  }
}

TEST(TimelineProperties, UndoGoesBackToEachMark) {
  for (int seed = 0; seed < kWorlds / 3 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Pair pair(static_cast<std::uint64_t>(seed));
    std::vector<std::pair<std::size_t, World>> marks;
    for (int step = 0; step < 15; ++step) {
      if (pair.draw.chance(40)) marks.emplace_back(pair.lines.mark(), pair.world);
      pair.change();
      if (!pair.draw.chance(20) || marks.empty()) continue;
      pair.lines.undo(marks.back().first);
      pair.world = marks.back().second;
      marks.pop_back();
    }
    for (; !marks.empty(); marks.pop_back()) {
      pair.lines.undo(marks.back().first);
      expect_values(marks.back().second, pair.lines);
      ASSERT_EQ(pair.lines.conflicts(Time{0}, Time{kEnd}),
                marks.back().second.conflicts(Time{0}, Time{kEnd}));
    }
  }
}

TEST(TimelineProperties, TheOrderOfPlacementsDoesNotMatter) {
  for (int seed = 0; seed < kWorlds / 3 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const Pair pair(static_cast<std::uint64_t>(seed));
    Timelines reversed(pair.world.definitions, Extent{.end = Time{kEnd}});
    for (const auto& [at, value] : pair.world.observations)
      reversed.observe(at.first, Time{at.second}, value);
    for (auto task = pair.world.tasks.rbegin(); task != pair.world.tasks.rend(); ++task)
      reversed.place(task->first, task->second.footprint, Time{task->second.start});
    expect_values(pair.world, reversed);
  }
}

/// Cuts off what a stretch has before `now`, where the past is forgotten.
std::vector<Conflict> from_now(std::vector<Conflict> conflicts, Time now) {
  for (Conflict& conflict : conflicts) conflict.from = std::max(conflict.from, now);
  std::ranges::sort(conflicts, [](const Conflict& a, const Conflict& b) {
    return std::tie(a.timeline, a.from, a.task, a.constraint) <
           std::tie(b.timeline, b.from, b.task, b.constraint);
  });
  return conflicts;
}

TEST(TimelineProperties, ConsolidationChangesNothingFromNowOn) {
  for (int seed = 0; seed < kWorlds && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Pair pair(static_cast<std::uint64_t>(seed));
    const int now = pair.draw.between(0, kEnd);
    pair.lines.consolidate(Time{pair.draw.between(0, now)});
    pair.lines.consolidate(Time{now});
    // Tasks that wait come, and those that run end at other times than planned, before the world is looked at.
    for (auto& [id, task] : pair.world.tasks) {
      if (task.end < now || pair.draw.chance(50)) continue;
      if (task.start >= now) task.start = pair.draw.between(now, kEnd);
      task.end = pair.draw.between(static_cast<int>(std::max<std::int64_t>(now, task.start)), kEnd);
      pair.lines.move(id, Time{task.start}, Time{task.end});
    }
    if (pair.draw.chance(50)) pair.observe(now);
    expect_values(pair.world, pair.lines, now);
    ASSERT_EQ(pair.lines.conflicts(Time{now}, Time{kEnd}),
              from_now(pair.world.conflicts(Time{now}, Time{kEnd}), Time{now}));
    const Footprint footprint = pair.draw.footprint(pair.world.definitions, 12);
    ASSERT_EQ(pair.lines.valid_starts(footprint, kAll),
              pair.world.valid_starts(footprint, {Time{now}, Time{kEnd}}));
  }
}

}  // namespace
}  // namespace roci::temporal::timelines
