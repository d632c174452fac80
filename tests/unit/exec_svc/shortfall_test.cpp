#include "exec_svc/reactor/shortfall.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::exec {
namespace {

using temporal::ActivityState;
using temporal::ConditionOp;

struct Draw {
  double needs;
  double takes;
  ActivityState state = ActivityState::waiting;
};

std::string lacking(const std::vector<Draw>& draws, double battery) {
  temporal::FlexiblePlan plan;
  std::vector<StepStatus> steps;
  for (const Draw& draw : draws) {
    temporal::PlanActivity activity;
    activity.id = "a" + std::to_string(steps.size() + 1);
    activity.pre = temporal::all_of({temporal::compare("(at home)", ConditionOp::eq, true),
                                     temporal::compare("(battery)", ConditionOp::ge, draw.needs)});
    activity.impacts = {
        {"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -draw.takes}};
    plan.activities.push_back(std::move(activity));
    steps.emplace_back().state = draw.state;
  }
  return shortfall(plan, steps, [&](const std::string& name) -> std::optional<temporal::Value> {
    if (name == "(battery)") return battery;
    return std::nullopt;
  });
}

TEST(Shortfall, NamesTheFirstActivityThatWillLackSomething) {
  EXPECT_EQ(lacking({{50, 30}, {60, 40}}, 90), "");
  EXPECT_EQ(lacking({{50, 30}, {60, 40}}, 89), "a2 will lack (battery) >= 60 (is 59)");
  EXPECT_EQ(lacking({{50, 30}, {60, 40}}, 49), "a1 will lack (battery) >= 50 (is 49)");
}

TEST(Shortfall, WhatRunsOrIsDoneTakesNothingMore) {
  EXPECT_EQ(lacking({{50, 30, ActivityState::running}, {60, 40}}, 60), "");
  EXPECT_EQ(lacking({{50, 30, ActivityState::succeeded}, {60, 40}}, 60), "");
  EXPECT_NE(lacking({{50, 30, ActivityState::running}, {60, 40}}, 59), "");
}

TEST(Shortfall, AnUnseenLevelIsNoAlarm) {
  temporal::FlexiblePlan plan;
  temporal::PlanActivity activity;
  activity.pre = temporal::compare("(battery)", ConditionOp::ge, 10.0);
  activity.impacts = {{"(battery)", temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -5.0}};
  plan.activities.push_back(activity);
  EXPECT_EQ(shortfall(plan, {StepStatus{}}, [](const std::string&) { return std::nullopt; }), "");
}

// Against the sum worked out by hand: no alarm if and only if every prefix leaves what the next one needs.
TEST(Shortfall, AgreesWithPrefixSumsOnRandomPlans) {
  std::mt19937_64 random(5);
  int alarms = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Draw> draws(1 + random() % 6);
    for (Draw& draw : draws) draw = {static_cast<double>(random() % 50), static_cast<double>(random() % 30)};
    const double battery = static_cast<double>(random() % 120);
    double left = battery;
    const bool enough = std::all_of(draws.begin(), draws.end(), [&](const Draw& draw) {
      const bool holds = left >= draw.needs;
      left -= draw.takes;
      return holds;
    });
    EXPECT_EQ(lacking(draws, battery).empty(), enough) << round;
    alarms += !enough;
  }
  EXPECT_GT(alarms, 300);
  EXPECT_LT(alarms, 1700);
}

}  // namespace
}  // namespace roci::exec
