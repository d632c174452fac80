// What each of the five kinds of timeline does, worked out by hand.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/temporal/timelines/check.hpp"
#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

using Intervals = std::vector<Interval>;

Time s(double value) { return seconds(value); }
Interval from_to(double earliest, double latest) { return {s(earliest), s(latest)}; }
constexpr Duration kMicrosecond{1};

Footprint task(double duration, std::vector<Impact> impacts, std::vector<Constraint> constraints = {}) {
  return {s(duration), std::move(impacts), std::move(constraints)};
}

TEST(AtomicTimeline, IsUsedByOneTaskAtATime) {
  Timelines lines({{.name = "arm", .kind = Kind::atomic}});
  const Footprint use = task(10, {{0, ImpactKind::delta, ImpactWhen::during, 1}});
  lines.place(1, use, s(20));
  EXPECT_EQ(lines.value(0, s(20), Side::between), 0);
  EXPECT_EQ(lines.value(0, s(20)), 1);
  EXPECT_EQ(lines.value(0, s(30), Side::before), 1);
  EXPECT_EQ(lines.value(0, s(30), Side::between), 0);
  EXPECT_EQ(lines.valid_starts(use, from_to(0, 100)), (Intervals{from_to(0, 10), from_to(30, 100)}));
  lines.place(2, use, s(30));
  EXPECT_TRUE(lines.conflicts(s(0), s(100)).empty()) << "one ends where the other starts";
  lines.place(3, use, s(39));
  EXPECT_EQ(lines.conflicts(s(0), s(100)), (std::vector<Conflict>{{0, std::nullopt, 0, s(39), s(40)}}));
}

TEST(StateTimeline, IsAssignedAndHoldsUntilTheNextAssignment) {
  Timelines lines({{.name = "phase", .kind = Kind::state, .states = {"cruise", "landed", "sampling"}}});
  lines.place(1, task(5, {{0, ImpactKind::assign, ImpactWhen::at_end, 1}}), s(10));
  lines.place(2, task(5, {{0, ImpactKind::assign, ImpactWhen::at_start, 2}}), s(40));
  EXPECT_EQ(lines.value(0, s(15), Side::before), 0);
  EXPECT_EQ(lines.value(0, s(15), Side::between), 1);
  EXPECT_EQ(lines.value(0, s(40), Side::between), 1);
  EXPECT_EQ(lines.value(0, s(1000)), 2);
  const Constraint landed{.timeline = 0, .phase = Phase::pre, .states = 0b010};
  EXPECT_EQ(lines.valid_starts(task(3, {}, {landed}), from_to(0, 100)), (Intervals{from_to(15, 40)}));
  const Constraint throughout{.timeline = 0, .phase = Phase::maintenance, .states = 0b010};
  EXPECT_EQ(lines.valid_starts(task(3, {}, {throughout}), from_to(0, 100)), (Intervals{from_to(15, 37)}));
  const Constraint then{.timeline = 0, .phase = Phase::post, .states = 0b100};
  EXPECT_EQ(lines.valid_starts(task(3, {}, {then}), from_to(0, 100)),
            (Intervals{{s(37) + kMicrosecond, s(100)}}));
}

TEST(StateTimeline, AnAssignmentMayNotBreakWhatAnotherTaskAsksFor) {
  Timelines lines({{.name = "phase", .kind = Kind::state, .states = {"idle", "busy"}}});
  lines.place(1, task(10, {}, {{.timeline = 0, .phase = Phase::maintenance, .states = 0b01}}), s(50));
  const Footprint pulse = task(
      5, {{0, ImpactKind::assign, ImpactWhen::at_start, 1}, {0, ImpactKind::assign, ImpactWhen::at_end, 0}});
  EXPECT_EQ(lines.valid_starts(pulse, from_to(0, 100)), (Intervals{from_to(0, 45), from_to(60, 100)}))
      << "at 50 its end acts before the other begins";
}

TEST(StateTimeline, ATaskWithoutDurationActsAmongTheStarts) {
  Timelines lines({{.name = "earth", .kind = Kind::state, .states = {"hidden", "in view"}}});
  lines.place(7,
              task(0, {{0, ImpactKind::assign, ImpactWhen::at_start, 1}},
                   {{.timeline = 0, .phase = Phase::pre, .states = 0b01},
                    {.timeline = 0, .phase = Phase::post, .states = 0b10}}),
              s(8));
  EXPECT_EQ(lines.value(0, s(8), Side::between), 0);
  EXPECT_EQ(lines.value(0, s(8), Side::after), 1);
  EXPECT_TRUE(lines.conflicts(s(0), s(100)).empty());
}

TEST(ClaimableTimeline, SharesAreTakenAndGivenBack) {
  Timelines lines({{.name = "power", .kind = Kind::claimable, .initial = 0, .lowest = 0, .highest = 0.3}});
  lines.place(1, task(10, {{0, ImpactKind::delta, ImpactWhen::during, 0.1}}), s(10));
  const Footprint more = task(5, {{0, ImpactKind::delta, ImpactWhen::during, 0.2}});
  EXPECT_EQ(lines.valid_starts(more, from_to(0, 100)), (Intervals{from_to(0, 100)}))
      << "0.1 and 0.2 are 0.3 here";
  lines.place(2, more, s(12));
  EXPECT_EQ(lines.value(0, s(12)), 0.3);
  EXPECT_TRUE(lines.conflicts(s(0), s(100)).empty());
  const Footprint least = task(1, {{0, ImpactKind::delta, ImpactWhen::during, 1e-9}});
  EXPECT_EQ(lines.valid_starts(least, from_to(0, 100)), (Intervals{from_to(0, 11), from_to(17, 100)}));
  EXPECT_EQ(lines.value(0, s(20)), 0);
}

TEST(CumulativeTimeline, GoesUpAndDownByAmounts) {
  Timelines lines({{.name = "stored", .kind = Kind::cumulative, .initial = 2, .lowest = 0, .highest = 10}});
  lines.place(1, task(10, {{0, ImpactKind::delta, ImpactWhen::at_end, 5}}), s(10));
  lines.place(2, task(10, {{0, ImpactKind::delta, ImpactWhen::at_start, -6}}), s(40));
  lines.place(3, task(1, {{0, ImpactKind::assign, ImpactWhen::at_start, 9}}), s(80));
  EXPECT_EQ(lines.value(0, s(20)), 7);
  EXPECT_EQ(lines.value(0, s(40)), 1);
  EXPECT_EQ(lines.value(0, s(80)), 9);
  const Footprint take = task(1, {{0, ImpactKind::delta, ImpactWhen::at_start, -2}});
  EXPECT_EQ(lines.valid_starts(take, from_to(0, 100)), (Intervals{from_to(80, 100)}))
      << "before 80 it would leave -1 from 40 on; what comes before an assignment no longer counts behind it";
  const Footprint give = task(1, {{0, ImpactKind::delta, ImpactWhen::at_start, 4}});
  EXPECT_EQ(lines.valid_starts(give, from_to(0, 100)), (Intervals{{s(40), s(80) - kMicrosecond}}));
}

TEST(CumulativeRateTimeline, RunsUpAndDown) {
  Timelines lines(
      {{.name = "battery", .kind = Kind::cumulative_rate, .initial = 1000, .lowest = 0, .highest = 1000}},
      Extent{.end = s(1000)});
  lines.place(1, task(1000, {{0, ImpactKind::rate, ImpactWhen::during, -0.5}}), s(0));
  EXPECT_EQ(lines.value(0, s(100)), 950);
  EXPECT_EQ(lines.value(0, s(1000)), 500);
  const Footprint drive = task(100, {{0, ImpactKind::rate, ImpactWhen::during, -4}},
                               {{.timeline = 0, .phase = Phase::pre, .lowest = 900},
                                {.timeline = 0, .phase = Phase::post, .lowest = 500}});
  EXPECT_EQ(lines.valid_starts(drive, from_to(0, 1000)), (Intervals{from_to(0, 100)}));
  lines.place(2, drive, s(100));
  EXPECT_EQ(lines.value(0, s(150)), 725);
  EXPECT_EQ(lines.value(0, s(200)), 500);
  EXPECT_EQ(lines.value(0, s(1000)), 100);
  const Footprint again = task(26, {{0, ImpactKind::rate, ImpactWhen::during, -4}});
  EXPECT_TRUE(lines.valid_starts(again, from_to(0, 974)).empty()) << "104 where 100 are left";
  const Footprint on = task(1, {{0, ImpactKind::rate, ImpactWhen::at_start, -0.5}});
  EXPECT_EQ(lines.valid_starts(on, from_to(0, 999)), (Intervals{from_to(800, 999)}))
      << "it runs on until the end, and 200 s take 100";
}

TEST(CumulativeRateTimeline, TellsToTheMicrosecondWhenARangeIsLeft) {
  Timelines lines({{.name = "heat", .kind = Kind::cumulative_rate, .initial = 0, .lowest = 0, .highest = 1}},
                  Extent{.end = s(10)});
  lines.place(1, task(10, {{0, ImpactKind::rate, ImpactWhen::during, 0.3}}), s(0));
  const Time leaves{3'333'334};  // 0.3 × 3.333333 = 0.9999999
  EXPECT_EQ(lines.conflicts(s(0), s(10)), (std::vector<Conflict>{{0, std::nullopt, 0, leaves, s(10)}}));
}

TEST(Constraints, AreInConflictWhereTheResultLeavesWhatTheyAsk) {
  Timelines lines({{.name = "stored", .kind = Kind::cumulative, .initial = 2}});
  lines.place(4,
              task(20, {},
                   {{.timeline = 0, .phase = Phase::pre, .lowest = 3},
                    {.timeline = 0, .phase = Phase::maintenance, .highest = 2},
                    {.timeline = 0, .phase = Phase::post, .lowest = 5}}),
              s(10));
  lines.place(5, task(5, {{0, ImpactKind::delta, ImpactWhen::at_end, 2}}), s(10));
  EXPECT_EQ(
      lines.conflicts(s(0), s(100)),
      (std::vector<Conflict>{{0, 4, 0, s(10), s(10)}, {0, 4, 1, s(15), s(30)}, {0, 4, 2, s(30), s(30)}}));
  EXPECT_EQ(lines.conflicts(s(29), s(29)), (std::vector<Conflict>{{0, 4, 1, s(15), s(30)}}))
      << "whole stretches that touch the window";
}

TEST(Trajectory, HasACornerWhereTheCourseTurnsOrJumps) {
  Timelines lines({{.name = "battery", .kind = Kind::cumulative_rate, .initial = 10}});
  lines.place(1,
              task(4, {{0, ImpactKind::rate, ImpactWhen::during, -1},
                       {0, ImpactKind::delta, ImpactWhen::at_end, -2}}),
              s(2));
  lines.observe(0, s(8), 3.5);
  EXPECT_EQ(lines.trajectory(0, s(1), s(10)), (std::vector<Vertex>{{s(1), 10, false},
                                                                   {s(2), 10, false},
                                                                   {s(6), 6, false},
                                                                   {s(6), 4, false},
                                                                   {s(8), 4, false},
                                                                   {s(8), 3.5, true},
                                                                   {s(10), 3.5, false}}));
  EXPECT_EQ(lines.trajectory(0, s(3), s(4)), (std::vector<Vertex>{{s(3), 9, false}, {s(4), 8, false}}));
}

}  // namespace
}  // namespace roci::temporal::timelines
