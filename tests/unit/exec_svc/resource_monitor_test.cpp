#include "exec_svc/reactor/resource_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::exec {

using reactor::ResourceMonitor;

namespace {

using temporal::ConditionOp;
using temporal::ImpactKind;
using temporal::ImpactWhen;

struct Draw {
  double needs;
  double takes;
};

temporal::PlanActivity activity_of(const Draw& draw, std::size_t number) {
  temporal::PlanActivity activity;
  activity.id = "a" + std::to_string(number);
  activity.pre = temporal::all_of({temporal::compare("(at home)", ConditionOp::eq, true),
                                   temporal::compare("(battery)", ConditionOp::ge, draw.needs)});
  activity.impacts = {{"(battery)", ImpactKind::delta, ImpactWhen::at_start, -draw.takes}};
  return activity;
}

temporal::FlexiblePlan plan_of(const std::vector<Draw>& draws) {
  temporal::FlexiblePlan plan;
  for (const Draw& draw : draws) plan.activities.push_back(activity_of(draw, plan.activities.size() + 1));
  return plan;
}

temporal::Lookup levels(std::map<std::string, double> values) {
  return [values = std::move(values)](const std::string& name) -> std::optional<temporal::Value> {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<temporal::Value>(found->second);
  };
}

std::string shortfall(const ResourceMonitor& monitor, const temporal::Lookup& now) {
  const auto conflict = monitor.conflict(now);
  return conflict ? conflict->activity + " will lack " + conflict->description : "";
}

std::string shortfall(const std::vector<Draw>& draws, double battery) {
  return shortfall(ResourceMonitor(plan_of(draws)), levels({{"(battery)", battery}}));
}

// The waiting activities gone through one by one.
std::string by_hand(const temporal::FlexiblePlan& plan, const std::vector<bool>& waits, double battery) {
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    if (!waits[i]) continue;
    const auto& nodes = plan.activities[i].pre.nodes;
    for (const temporal::ConditionNode& node : nodes)
      if (node.timeline == "(battery)" && battery < std::get<double>(node.operand))
        return plan.activities[i].id;
    battery += std::get<double>(plan.activities[i].impacts.front().amount);
  }
  return "";
}

TEST(ResourceMonitor, NameTheFirstActivityThatWillLackSomething) {
  EXPECT_EQ(shortfall({{50, 30}, {60, 40}}, 90), "");
  EXPECT_EQ(shortfall({{50, 30}, {60, 40}}, 89), "a2 will lack (battery) >= 60 (is 59)");
  EXPECT_EQ(shortfall({{50, 30}, {60, 40}}, 49), "a1 will lack (battery) >= 50 (is 49)");
}

TEST(ResourceMonitor, WhatIsGivenBackAtAnActivitysEndIsWaitedFor) {
  temporal::FlexiblePlan plan = plan_of({{0, 1}, {0, 1}});
  for (temporal::PlanActivity& activity : plan.activities) {
    activity.pre = temporal::compare("(battery)", ConditionOp::le, 0.0);
    activity.impacts = {{"(battery)", ImpactKind::delta, ImpactWhen::during, 1.0}};
  }
  EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(battery)", 1}})), "");
}

TEST(ResourceMonitor, WhatWaitsNoMoreTakesNothing) {
  ResourceMonitor monitor(plan_of({{50, 30}, {60, 40}}));
  monitor.remove("a1");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 60}})), "");
  EXPECT_NE(shortfall(monitor, levels({{"(battery)", 59}})), "");
}

// R99: the second attempt takes all of it once more, and is charged until it is seen to be taken.
TEST(ResourceMonitor, ARetryIsChargedAgain) {
  ResourceMonitor monitor(plan_of({{50, 30}, {60, 40}}));
  monitor.remove("a1");
  monitor.charge_again("a1", levels({{"(battery)", 80}}));
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 80}})), "a2 will lack (battery) >= 60 (is 50)");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 65}})), "a2 will lack (battery) >= 60 (is 50)");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 95}})), "") << "charged meanwhile";
  monitor.settle("a1");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 65}})), "");
}

// A drive under way will lower the battery under the bound of the activity after it: no alarm while it may, one as soon
// as it has ended and its end is seen without that.
TEST(ResourceMonitor, WhatARunningActivityWillStillTakeCountsForAnUpperBound) {
  temporal::FlexiblePlan plan = plan_of({{0, 30}, {0, 0}});
  plan.activities[1].pre = temporal::compare("(battery)", ConditionOp::le, 75.0);
  ResourceMonitor monitor(plan);
  monitor.remove("a1");
  monitor.begin("a1");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 100}})), "");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 106}})), "a2 will lack (battery) <= 75 (is 76)");
  monitor.end("a1", levels({{"(battery)", 90}}));
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 90}})), "") << "its end is not seen yet";
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 80}})), "a2 will lack (battery) <= 75 (is 80)");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 75}})), "");
}

TEST(ResourceMonitor, WhatARunningActivityWillStillGiveCountsForALowerBound) {
  temporal::FlexiblePlan plan = plan_of({{0, -50}, {60, 0}});
  ResourceMonitor monitor(plan);
  monitor.remove("a1");
  monitor.begin("a1");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 20}})), "");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 9}})), "a2 will lack (battery) >= 60 (is 59)");
  monitor.settle("a1");
  EXPECT_EQ(shortfall(monitor, levels({{"(battery)", 20}})), "a2 will lack (battery) >= 60 (is 20)");
}

// Whatever the domain says of when a drive takes its energy, it takes it at once, in the end or little by little: no
// alarm meanwhile while the plan fits, and what is taken counts once. What is lost beside it is missed as soon as no
// such course could explain it, at its end at the latest.
TEST(ResourceMonitor, WhatARunningActivityTakesCountsOnceWheneverItIsTaken) {
  std::mt19937_64 random(11);
  int fits = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Draw> draws(2 + random() % 5);
    for (Draw& draw : draws) draw = {static_cast<double>(random() % 60), static_cast<double>(random() % 30)};
    const temporal::FlexiblePlan plan = plan_of(draws);
    ResourceMonitor monitor(plan);
    const double begun = 80 + static_cast<double>(random() % 80), takes = draws[0].takes;
    monitor.remove("a1");
    monitor.begin("a1");
    const double lost = static_cast<double>(random() % 3 == 0 ? random() % 40 : 0);
    std::vector<bool> waits(draws.size(), true);
    waits[0] = false;
    const bool plan_fits = shortfall(monitor, levels({{"(battery)", begun - takes - lost}})).empty();
    std::vector<double> parts{0, takes};
    for (int i = 0; i < 6; ++i) parts.push_back(takes * static_cast<double>(random() % 101) / 100);
    std::ranges::sort(parts);
    for (const double taken : parts) {
      const std::string meanwhile = shortfall(monitor, levels({{"(battery)", begun - taken - lost}}));
      EXPECT_TRUE(meanwhile.empty() || !plan_fits) << round << ": " << meanwhile;
    }
    const double after = begun - takes - lost;
    monitor.end("a1", levels({{"(battery)", after + 1}}));
    const std::string expected = by_hand(plan, waits, after);
    const std::string got = shortfall(monitor, levels({{"(battery)", after}}));
    EXPECT_EQ(got.substr(0, got.find(' ')), expected) << round;
    EXPECT_EQ(plan_fits, expected.empty()) << round;
    fits += plan_fits ? 1 : 0;
  }
  EXPECT_GT(fits, 200);
  EXPECT_LT(fits, 1800);
}

TEST(ResourceMonitor, AnUnseenLevelIsNoAlarm) {
  EXPECT_EQ(shortfall(ResourceMonitor(plan_of({{10, 5}})), levels({})), "");
}

// What is filled up, or runs at a rate, has no sum: no alarm is better than a false one.
TEST(ResourceMonitor, ALevelThatIsSetOrRunsAtARateIsNoAlarm) {
  for (const ImpactKind kind : {ImpactKind::assign, ImpactKind::rate}) {
    temporal::FlexiblePlan plan = plan_of({{50, 30}});
    temporal::PlanActivity& charge = *plan.activities.emplace(plan.activities.begin());
    charge.id = "charge";
    charge.impacts = {{"(battery)", kind, temporal::ImpactWhen::at_end, 100.0}};
    EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(battery)", 10}})), "");
  }
}

TEST(ResourceMonitor, WhatIsLostByRoundingIsNotMissed) {
  EXPECT_EQ(shortfall({{0.1, 0.1}, {0.2, 0.2}, {0, 0}}, 0.3), "");
  EXPECT_NE(shortfall({{0.1, 0.1}, {0.2, 0.2}, {0, 0}}, 0.2999), "");
}

TEST(ResourceMonitor, AFullStoreIsMissedToo) {
  temporal::FlexiblePlan plan;
  for (int i = 1; i <= 3; ++i) {
    temporal::PlanActivity& activity = plan.activities.emplace_back();
    activity.id = "take-image-" + std::to_string(i);
    activity.pre = temporal::compare("(memory)", ConditionOp::le, 20.0);
    activity.impacts = {{"(memory)", ImpactKind::delta, ImpactWhen::at_end, 10.0}};
  }
  EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(memory)", 0}})), "");
  EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(memory)", 1}})),
            "take-image-3 will lack (memory) <= 20 (is 21)");
}

// One part of an alternative that fails is no lack; nor is a comparison that must not hold.
TEST(ResourceMonitor, OnlyWhatMustHoldIsADemand) {
  temporal::FlexiblePlan plan = plan_of({{10, 5}});
  temporal::PlanActivity& activity = plan.activities.front();
  const auto low = temporal::compare("(battery)", ConditionOp::ge, 80.0);
  activity.pre = temporal::any_of({low, temporal::compare("(docked)", ConditionOp::eq, true)});
  EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(battery)", 50}})), "");
  activity.pre = temporal::negate(low);
  EXPECT_EQ(shortfall(ResourceMonitor(plan), levels({{"(battery)", 50}})), "");
  activity.pre = temporal::all_of({low, temporal::compare("(docked)", ConditionOp::eq, true)});
  EXPECT_NE(shortfall(ResourceMonitor(plan), levels({{"(battery)", 50}})), "");
}

TEST(ResourceMonitor, AgreeWithAWalkOverThePlanWhileItIsWorkedOff) {
  std::mt19937_64 random(5);
  int alarms = 0;
  int looks = 0;
  for (int round = 0; round < 1000; ++round) {
    std::vector<Draw> draws(1 + random() % 9);
    for (Draw& draw : draws)
      draw = {static_cast<double>(random() % 50), static_cast<double>(random() % 30) - 8};
    const temporal::FlexiblePlan plan = plan_of(draws);
    ResourceMonitor monitor(plan);
    std::vector<bool> waits(draws.size(), true);
    for (std::size_t look = 0; look <= draws.size(); ++look, ++looks) {
      const double battery = static_cast<double>(random() % 120);
      const std::string expected = by_hand(plan, waits, battery);
      const std::string got = shortfall(monitor, levels({{"(battery)", battery}}));
      EXPECT_EQ(got.substr(0, got.find(' ')), expected) << round;
      alarms += !expected.empty();
      const std::size_t gone = random() % draws.size();
      waits[gone] = false;
      monitor.remove(plan.activities[gone].id);
    }
  }
  EXPECT_GT(alarms, looks / 10);
  EXPECT_LT(alarms, looks * 9 / 10);
}

}  // namespace
}  // namespace roci::exec
