// Flexible timelines: a sound plan, one mutation for each fault,
// and random plans against shortest paths between all points.
#include "core/temporal/timeline_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>

#include "core/temporal/network_distances.hpp"
#include "tests/unit/core/temporal/floyd_warshall.hpp"

namespace roci::temporal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Duration kHorizon = seconds(100);

// Wheels stand, drive for 10 to 20 s, and stand again; the mast looks within that time. Points 1 to 3 are the wheels',
// 4 to 6 the mast's; 7 is the end of the drive as its activity has it.
FlexiblePlan two_timelines() {
  FlexiblePlan plan;
  plan.point_count = 8;
  plan.tokens = {{"wheels", state("at", {"a"}), 0, 1},
                 {"mast", state("stowed"), 0, 4},
                 {"wheels", state("drive", {"a", "b"}), 1, 2},
                 {"mast", state("look"), 4, 5},
                 {"mast", state("stowed"), 5, 6},
                 {"wheels", state("at", {"b"}), 7, 3}};
  plan.constraints = {{1, 2, ConstraintKind::duration, seconds(10), seconds(20)},
                      {4, 5, ConstraintKind::duration, seconds(5), seconds(8)},
                      {5, 1, ConstraintKind::ordering, seconds(0), no_bound},
                      {2, 7, ConstraintKind::ordering, seconds(0), seconds(0)},
                      {0, 3, ConstraintKind::window, kHorizon, kHorizon},
                      {3, 6, ConstraintKind::ordering, seconds(0), seconds(0)}};
  return plan;
}

std::vector<std::string> timeline_faults_after(const std::function<void(FlexiblePlan&)>& harm) {
  FlexiblePlan plan = two_timelines();
  harm(plan);
  return timeline_faults(plan, kHorizon);
}

TEST(TimelineForm, AcceptsTimelinesFromOriginToHorizon) {
  EXPECT_THAT(check(two_timelines()), IsEmpty());
  EXPECT_THAT(timeline_faults(two_timelines(), kHorizon), IsEmpty());
  EXPECT_THAT(timeline_faults(FlexiblePlan{}, kHorizon), IsEmpty());
}

TEST(TimelineForm, TellsValuesOutOfOrder) {
  EXPECT_THAT(timeline_faults_after([](auto& p) { std::swap(p.tokens[2], p.tokens[5]); }),
              ElementsAre(HasSubstr("there is a gap of [10 s, 20 s] between at(a) and at(b)"),
                          HasSubstr("drive(a, b) begins before at(b) ends"),
                          HasSubstr("its last value, drive(a, b), ends in [15 s, 100 s]")));
}

TEST(TimelineForm, TellsGapsAndOverlaps) {
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.tokens.erase(p.tokens.begin() + 2); }),
      ElementsAre(HasSubstr("timeline wheels: there is a gap of [10 s, 20 s] between at(a) and at(b)")));
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.constraints[3].lower = p.constraints[3].upper = seconds(1); }),
      ElementsAre(HasSubstr("there is a gap of [1 s, 1 s] between drive(a, b) and at(b)")));
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.constraints[3].upper = seconds(1); }),
      ElementsAre(HasSubstr("drive(a, b) and at(b) are not joined: from the end of one to the start of "
                            "the other it may be [0 s, 1 s]")));
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.tokens[0].end_point = 2; }),
      ElementsAre(HasSubstr("drive(a, b) begins before at(a) ends: they overlap, or stand out of order")));
}

TEST(TimelineForm, TellsWhatDoesNotReachFromOriginToHorizon) {
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.tokens.erase(p.tokens.begin()); }),
      ElementsAre(HasSubstr("timeline wheels: its first value, drive(a, b), begins in [5 s, 90 s] and not "
                            "at the origin")));
  EXPECT_THAT(
      timeline_faults_after([](auto& p) { p.tokens.pop_back(); }),
      ElementsAre(HasSubstr("timeline wheels: its last value, drive(a, b), ends in [15 s, unbounded] and not "
                            "at the horizon, 100 s")));
  EXPECT_THAT(timeline_faults_after([](auto& p) { p.constraints[4].lower = seconds(99); }),
              ElementsAre(HasSubstr("timeline mast: its last value, stowed, ends in [99 s, 100 s]"),
                          HasSubstr("timeline wheels: its last value, at(b), ends in [99 s, 100 s]")));
  EXPECT_THAT(timeline_faults(two_timelines(), seconds(101)),
              ElementsAre(HasSubstr("not at the horizon, 101 s"), HasSubstr("not at the horizon, 101 s")));
}

TEST(TimelineForm, TellsBoundsThatContradictEachOther) {
  EXPECT_THAT(
      timeline_faults_after([](auto& p) {
        p.constraints.push_back({1, 2, ConstraintKind::duration, seconds(21), no_bound});
      }),
      ElementsAre(HasSubstr("timeline wheels: the bounds of how long it holds drive(a, b) contradict")));
  EXPECT_THAT(timeline_faults_after([](auto& p) {
                p.constraints.push_back({0, 2, ConstraintKind::window, seconds(0), seconds(14)});
              }),
              ElementsAre(HasSubstr("no schedule: point 2 cannot lie [0 s, 14 s] after point 0")));
}

// All distances of a plan's network, the textbook way; nothing if it has no schedule.
std::optional<FloydWarshall> all_distances(const FlexiblePlan& plan) {
  FloydWarshall out(plan.point_count);
  for (const TemporalConstraint& c : all_constraints(plan))
    if (!out.add(c.from_point, c.to_point, c.lower, c.upper)) return std::nullopt;
  return out;
}

FlexiblePlan random_plan(std::mt19937_64& random) {
  const auto below = [&](std::uint64_t n) { return static_cast<std::uint32_t>(random() % n); };
  FlexiblePlan plan;
  plan.point_count = 4 + below(5);
  for (std::uint32_t i = 0, n = 2 + below(4); i < n; ++i) {
    const TimePoint start = below(plan.point_count), end = below(plan.point_count);
    plan.tokens.push_back({below(2) == 0 ? "a" : "b", state("s" + std::to_string(i)), start, end});
    // Mostly joined to the one before, since few random plans are.
    if (i > 0 && below(4) != 0) {
      plan.tokens[i].timeline = plan.tokens[i - 1].timeline;
      plan.tokens[i].start_point = plan.tokens[i - 1].end_point;
    }
  }
  for (std::uint32_t i = 0, n = below(8); i < n; ++i) {
    const TimePoint from = below(plan.point_count), to = below(plan.point_count);
    const Duration lower = Duration{below(4)}, upper = below(3) == 0 ? no_bound : lower + Duration{below(2)};
    if (from != to) plan.constraints.push_back({from, to, ConstraintKind::ordering, lower, upper});
  }
  if (below(2) == 0) plan.tokens.front().start_point = 0;
  const TimePoint last = plan.tokens.back().end_point;
  if (below(2) == 0 && last != 0)
    plan.constraints.push_back({0, last, ConstraintKind::window, Duration{5}, Duration{5}});
  return plan;
}

TEST(TimelineFormProperty, AgreesWithAllShortestPathsOnRandomPlans) {
  std::mt19937_64 random(142);
  int sound = 0, faulty = 0, contradictory = 0;
  for (int run = 0; run < 20000; ++run) {
    const FlexiblePlan plan = random_plan(random);
    const Duration horizon{5};
    auto all = all_distances(plan);
    const auto faults = timeline_faults(plan, horizon);
    if (!all) {
      ++contradictory;
      EXPECT_EQ(faults.size(), 1U);
      continue;
    }
    const auto apart = [&](TimePoint from, TimePoint to, Duration by) {
      return all->between(from, to) == Window{by, by};
    };
    std::size_t expected = 0;
    for (const char* name : {"a", "b"}) {
      const Token* before = nullptr;
      for (const Token& token : plan.tokens) {
        if (token.timeline != name) continue;
        if (!apart(before == nullptr ? origin_point : before->end_point, token.start_point, Duration{0}))
          ++expected;
        before = &token;
      }
      if (before != nullptr && !apart(origin_point, before->end_point, horizon)) ++expected;
    }
    ASSERT_EQ(faults.size(), expected) << "run " << run;
    ++(expected == 0 ? sound : faulty);
  }
  EXPECT_GT(sound, 50);
  EXPECT_GT(faulty, 1000);
  EXPECT_GT(contradictory, 1000);
}

TEST(NetworkDistancesProperty, AreThoseOfAllShortestPaths) {
  std::mt19937_64 random(143);
  int asked = 0;
  for (int run = 0; run < 3000; ++run) {
    const FlexiblePlan plan = random_plan(random);
    const NetworkDistances network(plan.point_count, all_constraints(plan));
    auto all = all_distances(plan);
    ASSERT_EQ(network.consistent(), all.has_value());
    if (!all) continue;
    for (TimePoint a = 0; a < plan.point_count; ++a)
      for (TimePoint b = 0; b < plan.point_count; ++b) {
        const Window apart = network.between(a, b);
        ASSERT_EQ(apart, all->between(a, b));
        const Duration upper{static_cast<std::int64_t>(random() % 8)}, lower = upper - Duration{random() % 6};
        ASSERT_EQ(network.implies(a, b, lower, upper), apart.lower >= lower && apart.upper <= upper);
        ++asked;
      }
  }
  EXPECT_GT(asked, 10000);
}

}  // namespace
}  // namespace roci::temporal
