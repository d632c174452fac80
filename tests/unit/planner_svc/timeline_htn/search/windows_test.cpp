// What is known to come is planned with: what needs it stands inside of its window,
// the earliest that fits, or there is no plan.
#include "tests/unit/planner_svc/timeline_htn/reading/windows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/temporal/network_distances.hpp"
#include "planner_svc/timeline_htn/checking/check.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn {
namespace {

using reading::kWindows;
using search::Heuristic, search::Order, search::Outcome;
using temporal::seconds;
using testing::HasSubstr, testing::IsEmpty;

/// The earliest start and the latest end of an activity.
std::pair<temporal::Duration, temporal::Duration> span_of(const temporal::FlexiblePlan& plan,
                                                          const std::string& name) {
  const temporal::NetworkDistances network(plan.point_count, temporal::all_constraints(plan));
  for (const auto& activity : plan.activities)
    if (activity.name == name)
      return {network.between(0, activity.start_point).lower, network.between(0, activity.end_point).upper};
  ADD_FAILURE() << "no activity " << name;
  return {};
}

// The first window is too short, the second takes two messages, and the third the last one.
TEST(TimelineWindows, WhatNeedsOneStandsInTheEarliestThatFits) {
  const auto model = model_of({kWindows});
  const auto result = planned(model);
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_EQ(span_of(*result.plan, "antenna.sending(first)"), std::pair(seconds(600), seconds(670)));
  EXPECT_EQ(span_of(*result.plan, "antenna.sending(second)"), std::pair(seconds(660), seconds(730)));
  EXPECT_EQ(span_of(*result.plan, "antenna.sending(third)").first, seconds(2000));
  EXPECT_THAT(checking::faults(model, *result.plan), IsEmpty());
}

TEST(TimelineWindows, EachHeuristicAndOrderPlansInThem) {
  const auto model = model_of({kWindows});
  for (const Heuristic heuristic : {Heuristic::blind, Heuristic::relaxed_plan, Heuristic::landmarks})
    for (const Order order : {Order::first_declared, Order::last_declared}) {
      const auto result = planned(model, {heuristic, order});
      ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
      EXPECT_THAT(checking::faults(model, *result.plan), IsEmpty());
    }
}

// The executive waits for the window all the same: it may come later than it was predicted.
TEST(TimelineWindows, TheExecutiveStillWaitsForThem) {
  const auto result = planned(model_of({kWindows}));
  ASSERT_TRUE(result.plan);
  const auto* sending = result.find("antenna.sending(first)");
  EXPECT_EQ(temporal::describe(sending->pre), "ground.window = true");
  EXPECT_EQ(temporal::describe(sending->maintenance), "ground.window = true");
}

// Before any step is tried, however many goals there are.
TEST(TimelineWindows, WhereNoneIsLeftBeforeTheDeadlineThatIsProved) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& reason) {
    const auto result = planned(model_of({with(kWindows, from, to)}));
    EXPECT_EQ(result.outcome, Outcome::exhausted);
    EXPECT_EQ(result.reason, reason);
    EXPECT_EQ(result.count.evaluated, 0U);
  };
  expect("one: mission.told(first)", "one: {state: antenna.sending(first), window_s: [0, 500]}",
         "antenna.sending(first) comes about at 600 s at the earliest, since antenna.sending(first) waits "
         "for ground.seen as predicted, and its window closes at 500 s");
  expect("one: mission.told(first)", "one: {state: mission.told(first), window_s: [0, 659]}",
         "mission.told(first) comes about at 660 s at the earliest, since antenna.sending(first) waits for "
         "ground.seen as predicted, and its window closes at 659 s");
  expect("two: mission.told(second)", "two: {state: antenna.sending(second), window_s: [680, 1999]}",
         "antenna.sending(second) comes about at 2000 s at the earliest, since antenna.sending(second) waits "
         "for ground.seen as predicted, and its window closes at 1999 s");
  const std::size_t from = kWindows.find("      - {at_s: 100"), to = kWindows.find("  goals: {one");
  expect(kWindows.substr(from, to - from), "      []\n",
         "mission.told(first) does not come about: antenna.sending(first) waits for ground.seen as "
         "predicted, and there is no time for it");
}

// Each message alone would have its time.
TEST(TimelineWindows, WhereTheyDoNotTakeAllThatIsFoundBySearching) {
  const auto third = planned(model_of({with(kWindows, "at_s: 2000", "at_s: 3541")}));
  EXPECT_EQ(third.outcome, Outcome::exhausted);
  EXPECT_THAT(third.reason,
              HasSubstr("needs ground.seen, and no time at which that is predicted is left for it: "
                        "100 s to 130 s, 600 s to 730 s, 3541 s to 3600 s"));
}

// A plan never changes it, not even where transitions and the problem's silence would let it.
TEST(TimelineWindows, WithoutPredictedValuesAPlanBringsTheStateAbout) {
  const std::size_t from = kWindows.find("  predicted:"), to = kWindows.find("  goals: {one");
  const auto free = planned(model_of({std::string(kWindows).erase(from, to - from)}));
  ASSERT_EQ(free.outcome, Outcome::solved);
  EXPECT_EQ(span_of(*free.plan, "antenna.sending(first)").first, seconds(0));
}

TEST(TimelineWindows, ABehaviourBeginsWhereItsConditionIsPredicted) {
  const std::string asks =
      with(with(kWindows, ", needs: [during ground.seen]", ""), "achieves: mission.telling(what), ",
           "achieves: mission.telling(what), conditions: [ground.seen], ");
  const auto model = model_of({asks});
  const auto result = planned(model);
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_EQ(span_of(*result.plan, "mission.telling(first)").first, seconds(100));
  EXPECT_THAT(checking::faults(model, *result.plan), IsEmpty());
  const auto negated = planned(model_of({with(asks, "[ground.seen]", "[not ground.hidden]")}));
  ASSERT_EQ(negated.outcome, Outcome::solved) << negated.reason;
  EXPECT_EQ(span_of(*negated.plan, "mission.telling(first)").first, seconds(100));
  const auto late = planned(
      model_of({with(asks, "one: mission.told(first), two: mission.told(second), three: mission.told(third)",
                     "one: {state: mission.telling(first), window_s: [140, 599]}")}));
  EXPECT_EQ(late.outcome, Outcome::exhausted);
  EXPECT_THAT(late.reason, HasSubstr("mission.telling(first) comes about at 600 s at the earliest"));
}

// Twenty messages and a hundred windows, of which each takes one message: no choice is made twice.
TEST(TimelineWindows, ManyCostNoMoreThanTheyAre) {
  std::string windows, texts = "t0", goals;
  for (int w = 0; w < 100; ++w)
    windows += "      - {at_s: " + std::to_string(300 * w + 100) +
               ", state: seen}\n      - {at_s: " + std::to_string(300 * w + 200) + ", state: hidden}\n";
  for (int g = 1; g < 20; ++g) texts += ", t" + std::to_string(g);
  for (int g = 0; g < 20; ++g)
    goals += (g == 0 ? "g0: mission.told(t0)"
                     : ", g" + std::to_string(g) + ": mission.told(t" + std::to_string(g) + ")");
  const std::size_t from = kWindows.find("      - {at_s: 100"), to = kWindows.find("  goals: {one");
  std::string many = kWindows;
  many.replace(from, to - from, windows);
  many = with(with(with(many, "first, second, third", texts), "horizon_s: 3600", "horizon_s: 40000"),
              "one: mission.told(first), two: mission.told(second), three: mission.told(third)", goals);
  const auto model = model_of({many});
  const auto result = planned(model);
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_LT(result.count.evaluated, 1000U);
  EXPECT_THAT(checking::faults(model, *result.plan), IsEmpty());
}

}  // namespace
}  // namespace roci::planner::timeline_htn
