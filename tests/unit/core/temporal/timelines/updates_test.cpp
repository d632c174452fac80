// Observations, actual times, consolidation and what undo() takes back.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

Time at(double value) { return seconds(value); }
const Definition kBattery{.name = "battery", .kind = Kind::cumulative_rate, .initial = 1000, .lowest = 0};
const Footprint kDrain{at(100), {{0, ImpactKind::rate, ImpactWhen::during, -1}}, {}};

TEST(Observations, AnchorTheTimelineAndRatesGoOn) {
  Timelines lines({kBattery});
  lines.place(1, kDrain, at(10));
  EXPECT_TRUE(lines.observe(0, at(60), 900));
  EXPECT_EQ(lines.value(0, at(60), Side::before), 950) << "what was foreseen";
  EXPECT_EQ(lines.value(0, at(60)), 900);
  EXPECT_EQ(lines.value(0, at(110)), 850) << "the task drains for 50 s more";
  EXPECT_EQ(lines.value(0, at(200)), 850);
  lines.observe(0, at(40), 700);
  EXPECT_EQ(lines.value(0, at(110)), 850) << "an older one comes late, the newest counts";
  lines.observe(0, at(60), 905);
  EXPECT_EQ(lines.value(0, at(110)), 855) << "the later word of one instant";
}

TEST(Observations, WhatIsTakenDuringATaskIsGivenBackBehindThem) {
  Timelines lines({{.name = "power", .kind = Kind::claimable}});
  lines.place(1, {at(10), {{0, ImpactKind::delta, ImpactWhen::during, 5}}, {}}, at(0));
  lines.observe(0, at(5), 7);
  EXPECT_EQ(lines.value(0, at(9)), 7);
  EXPECT_EQ(lines.value(0, at(10)), 2);
}

TEST(Observations, BehindTheConsolidatedPastDoNotCount) {
  Timelines lines({kBattery});
  lines.consolidate(at(50));
  EXPECT_FALSE(lines.observe(0, at(49), 1));
  EXPECT_EQ(lines.value(0, at(50)), 1000);
  EXPECT_TRUE(lines.observe(0, at(50), 2));
  EXPECT_EQ(lines.value(0, at(50)), 2);
}

TEST(ActualTimes, ALateStartAndAnOverrunShiftTheTimeline) {
  Timelines lines({kBattery});
  lines.place(1, kDrain, at(10));
  lines.move(1, at(30), at(150));
  EXPECT_EQ(lines.value(0, at(30)), 1000);
  EXPECT_EQ(lines.value(0, at(130)), 900);
  EXPECT_EQ(lines.value(0, at(200)), 880);
  const Footprint needs{at(1), {}, {{.timeline = 0, .phase = Phase::pre, .lowest = 900}}};
  EXPECT_EQ(lines.valid_starts(needs, {at(0), at(500)}), (std::vector<Interval>{{at(0), at(130)}}));
}

TEST(ActualTimes, OfATaskThatRunsItsEndMovesBehindTheConsolidatedPast) {
  Timelines lines({kBattery});
  lines.place(1, kDrain, at(10));
  lines.consolidate(at(60));
  lines.move(1, at(0), at(80));
  EXPECT_EQ(lines.value(0, at(60)), 950) << "the start stays";
  EXPECT_EQ(lines.value(0, at(200)), 930);
  lines.move(1, at(0), at(20));
  EXPECT_EQ(lines.value(0, at(200)), 950) << "it counts as ended at the edge";
}

TEST(Removal, OfATaskThatRunsGivesBackWhatItTakesDuringItself) {
  Timelines lines({kBattery, {.name = "power", .kind = Kind::claimable}});
  lines.place(1,
              {at(100),
               {{0, ImpactKind::rate, ImpactWhen::during, -1},
                {0, ImpactKind::delta, ImpactWhen::at_start, -50},
                {0, ImpactKind::delta, ImpactWhen::at_end, -500},
                {1, ImpactKind::delta, ImpactWhen::during, 3}},
               {}},
              at(0));
  lines.consolidate(at(40));
  const std::size_t mark = lines.mark();
  lines.remove(1);
  EXPECT_EQ(lines.value(0, at(300)), 910) << "it has drained 40 and taken 50";
  EXPECT_EQ(lines.value(1, at(40)), 0);
  lines.undo(mark);
  EXPECT_EQ(lines.value(0, at(300)), 350);
  EXPECT_EQ(lines.value(1, at(40)), 3);
}

TEST(Undo, RefusesMarksBehindAnObservationOrAConsolidation) {
  Timelines lines({kBattery});
  lines.place(1, kDrain, at(10));
  const std::size_t before = lines.mark();
  lines.observe(0, at(0), 5);
  EXPECT_THROW(lines.undo(before), std::logic_error);
  const std::size_t between = lines.mark();
  lines.consolidate(at(5));
  EXPECT_THROW(lines.undo(between), std::logic_error);
  EXPECT_THROW(lines.undo(lines.mark() + 1), std::logic_error);
  const std::size_t now = lines.mark();
  lines.remove(1);
  lines.undo(now);
  EXPECT_TRUE(lines.placed(1));
}

TEST(Copies, StandForThemselves) {
  Timelines lines({kBattery});
  lines.place(1, kDrain, at(10));
  const std::size_t mark = lines.mark();
  Timelines copy = lines;
  copy.place(2, kDrain, at(10));
  lines.remove(1);
  EXPECT_EQ(copy.value(0, at(110)), 800);
  EXPECT_EQ(lines.value(0, at(110)), 1000);
  copy.undo(mark);
  EXPECT_EQ(copy.value(0, at(110)), 900);
}

/// Flies for long: each step places a task or two ahead, hears what is,
/// ends what runs at other times than planned and consolidates.
TEST(Consolidation, KeepsMemoryFlatOverALongRun) {
  std::mt19937_64 random(1);
  Timelines lines({kBattery, {.name = "stored", .kind = Kind::cumulative}}, Extent{.most_impacts = 200});
  const Footprint work{
      at(50),
      {{0, ImpactKind::rate, ImpactWhen::during, -0.01}, {1, ImpactKind::delta, ImpactWhen::at_end, 1}},
      {{.timeline = 0, .phase = Phase::maintenance, .lowest = 1}}};
  TaskId next = 1;
  std::size_t most = 0;
  std::int64_t placed = 0;
  for (int step = 0; step < 20'000; ++step) {
    const Time now = at(30.0 * step);
    lines.place(next++, work, now + at(static_cast<double>(random() % 60)));
    ++placed;
    if (random() % 2 == 0 && lines.placed(next - 2))
      lines.move(next - 2, now, now + at(static_cast<double>(random() % 90)));
    if (random() % 3 == 0) lines.observe(0, now, 900);
    lines.consolidate(now);
    const Kept kept = lines.kept();
    most = std::max(most, kept.tasks + kept.events + kept.asks + kept.undoable);
  }
  EXPECT_LT(most, 60U);
  EXPECT_EQ(lines.value(1, at(1e6)), static_cast<double>(placed)) << "what was folded still counts";
}

}  // namespace
}  // namespace roci::temporal::timelines
