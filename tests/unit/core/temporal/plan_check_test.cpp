#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FlexiblePlan two_activities() {
  FlexiblePlan plan;
  plan.point_count = 5;
  for (const TimePoint first : {1U, 3U}) {
    PlanActivity activity;
    activity.id = first == 1 ? "a" : "b";
    activity.owner = "sim";
    activity.command_name = "drive";
    activity.start_point = first;
    activity.end_point = first + 1;
    activity.duration_lower = activity.duration_upper = seconds(10);
    plan.activities.push_back(activity);
  }
  plan.constraints.push_back({2, 3, ConstraintKind::ordering, Duration{1}, no_bound});
  return plan;
}

std::vector<std::string> faults_after(const std::function<void(FlexiblePlan&)>& harm) {
  FlexiblePlan plan = two_activities();
  harm(plan);
  return check(plan);
}

TEST(PlanCheck, AcceptsASoundPlan) { EXPECT_THAT(check(two_activities()), IsEmpty()); }

TEST(PlanCheck, NamesEachFaultOfAnActivity) {
  const auto fault = [](auto harm) {
    const auto faults = faults_after([&](FlexiblePlan& plan) { harm(plan.activities[1]); });
    return faults.size() == 1 ? faults.front() : std::to_string(faults.size()) + " faults";
  };
  EXPECT_THAT(fault([](auto& a) { a.id = "a"; }), HasSubstr("stands twice"));
  EXPECT_THAT(fault([](auto& a) { a.id = ""; }), HasSubstr("has no id"));
  EXPECT_THAT(fault([](auto& a) { a.end_point = 9; }), HasSubstr("not below point_count 5"));
  EXPECT_THAT(fault([](auto& a) { a.end_point = 1; }), HasSubstr("belongs to an activity already"));
  EXPECT_THAT(fault([](auto& a) { a.start_point = 0; }), HasSubstr("must not be the origin"));
  EXPECT_THAT(fault([](auto& a) { a.duration_upper = seconds(9); }), HasSubstr("is above upper bound 9 s"));
  EXPECT_THAT(fault([](auto& a) { a.duration_lower = seconds(-1); }), HasSubstr("negative"));
  EXPECT_THAT(fault([](auto& a) { a.command_name = ""; }), HasSubstr("no command"));
  EXPECT_THAT(fault([](auto& a) { a.wait_timeout = seconds(-1); }), HasSubstr("wait timeout is negative"));
  EXPECT_THAT(fault([](auto& a) { a.lateness = LatenessPolicy::push; }),
              HasSubstr("push needs a wait timeout"));
  EXPECT_THAT(fault([](auto& a) { a.pre = compare("", ConditionOp::eq, true); }), HasSubstr("pre: "));
  EXPECT_THAT(fault([](auto& a) { a.skip_if = any_of({}); }), HasSubstr("skip_if: "));
  EXPECT_THAT(fault([](auto& a) { a.parent = "c"; }), HasSubstr("its parent is not in the plan: c"));
  EXPECT_THAT(fault([](auto& a) { a.parent = "b"; }), HasSubstr("own ancestor"));
  EXPECT_THAT(fault([](auto& a) {
                a.impacts = {{"x", ImpactKind::delta, ImpactWhen::at_end, true}};
              }),
              HasSubstr("needs a number"));
  EXPECT_THAT(fault([](auto& a) {
                a.impacts = {{"x", ImpactKind::rate, ImpactWhen::at_end, 1.0}};
              }),
              HasSubstr("only act during"));
}

TEST(PlanCheck, NamesFaultsOfTokensAndConstraints) {
  EXPECT_THAT(faults_after([](auto& p) {
                p.tokens = {{"", {}, 1, 2}};
              }),
              ElementsAre(HasSubstr("no timeline")));
  EXPECT_THAT(faults_after([](auto& p) {
                p.tokens = {{"nav", {}, 1, 5}};
              }),
              ElementsAre(HasSubstr("end point 5")));
  const auto with = [](TemporalConstraint constraint) {
    return faults_after([&](FlexiblePlan& plan) { plan.constraints.push_back(constraint); });
  };
  EXPECT_THAT(with({1, 7, ConstraintKind::ordering, Duration{0}, no_bound}),
              ElementsAre(HasSubstr("to point 7")));
  EXPECT_THAT(with({1, 1, ConstraintKind::ordering, Duration{0}, no_bound}),
              ElementsAre(HasSubstr("with itself")));
  EXPECT_THAT(with({1, 2, ConstraintKind::window, Duration{-9}, Duration{-1}}),
              ElementsAre(HasSubstr("turn it")));
  EXPECT_THAT(with({1, 2, ConstraintKind::window, Duration{INT64_MAX / 2}, no_bound}),
              ElementsAre(HasSubstr("too large")));
}

TEST(PlanCheck, NamesFaultsOfDecisions) {
  const DecisionPoint sound{"route", "planner", {{"left", {"a"}}, {"right", {"b"}}}, 3};
  const auto with = [&](auto harm) {
    DecisionPoint decision = sound;
    harm(decision);
    return faults_after([&](FlexiblePlan& plan) { plan.decisions = {decision}; });
  };
  EXPECT_THAT(with([](auto&) {}), IsEmpty());
  EXPECT_THAT(with([](auto& d) { d.resolver = ""; }), IsEmpty()) << "anybody of the kind may decide";
  EXPECT_THAT(with([](auto& d) { d.resolver_kind = ResolverKind::rule; }),
              ElementsAre(HasSubstr("by the plan itself")));
  EXPECT_THAT(with([](auto& d) {
                d.resolver_kind = ResolverKind::rule;
                d.resolver = "";
                d.choices[0].rule.nodes = {{ConditionOp::all_of, 3}};
              }),
              ElementsAre(HasSubstr("rule")));
  EXPECT_THAT(with([](auto& d) { d.choices.clear(); }), ElementsAre(HasSubstr("no choices")));
  EXPECT_THAT(with([](auto& d) { d.choices[1].name = "left"; }), ElementsAre(HasSubstr("left stands twice")));
  EXPECT_THAT(with([](auto& d) { d.choices[1].activities = {"c"}; }), ElementsAre(HasSubstr("no activity")));
  const auto binding = [](auto& d) {
    d.choices.clear();
    d.bindings = {{"a", "to"}};
  };
  EXPECT_THAT(with(binding), IsEmpty());
  EXPECT_THAT(with([](auto& d) { d.bindings = {{"a", "to"}}; }), ElementsAre(HasSubstr("make two")));
  EXPECT_THAT(with([&](auto& d) {
                binding(d);
                d.bindings[0].activity = "nowhere";
              }),
              ElementsAre(HasSubstr("no activity of the plan: nowhere")));
  EXPECT_THAT(with([](auto& d) { d.decide_before = 0; }), ElementsAre(HasSubstr("origin")));
}

TEST(PlanCheck, ListsAllFaultsAtOnce) {
  EXPECT_EQ(faults_after([](auto& p) {
              p.activities[0].wait_timeout = seconds(-1);
              p.tokens = {{"", {}, 1, 2}};
              p.decisions = {{"", "", {}, 0, ResolverKind::rule}};
            }).size(),
            6U);
}

TEST(PlanCheck, FindsAnImpossibleNetwork) {
  EXPECT_THAT(faults_after([](auto& p) {
                p.constraints.push_back({0, 4, ConstraintKind::window, Duration{0}, seconds(19)});
              }),
              ElementsAre(HasSubstr("no schedule satisfies it: point 4")));
}

TEST(AllConstraints, MergesDurationsAtTheActivitysIndex) {
  FlexiblePlan plan = two_activities();
  plan.activities[1].duration_upper = seconds(20);
  plan.constraints.push_back({3, 4, ConstraintKind::duration, seconds(12), seconds(15)});
  const auto all = all_constraints(plan);
  EXPECT_EQ(all[1], (TemporalConstraint{3, 4, ConstraintKind::duration, seconds(12), seconds(15)}));
  EXPECT_EQ(all.size(), 2U + 4U + 1U);
}

}  // namespace
}  // namespace roci::temporal
