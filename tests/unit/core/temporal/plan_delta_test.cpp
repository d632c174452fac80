// Deltas between random versions of plans, against the versions themselves.
#include "core/temporal/plan_delta.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::temporal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

// Few values, so that versions share items and lists hold equal ones.
FlexiblePlan random_plan(std::uint32_t version, std::mt19937_64& random) {
  const auto any = [&random](std::uint32_t most) {
    return static_cast<std::uint32_t>(random() % (most + 1));
  };
  FlexiblePlan plan;
  plan.id = "p";
  plan.version = version;
  plan.engine = "e";
  plan.origin = seconds(any(3));
  plan.point_count = 20;
  for (std::uint32_t i = 0; i < 8; ++i) {
    if (any(2) == 0) continue;
    PlanActivity activity;
    activity.id = "a" + std::to_string(i);
    activity.start_point = 2 * i + 1;
    activity.end_point = 2 * i + 2;
    activity.duration_lower = seconds(any(1));
    activity.commit = any(1) == 0 ? CommitState::planned : CommitState::committed;
    plan.activities.push_back(activity);
  }
  std::shuffle(plan.activities.begin(), plan.activities.end(), random);
  for (std::uint32_t i = any(6); i > 0; --i)
    plan.constraints.push_back({any(2), any(2), ConstraintKind::ordering, seconds(any(1)), no_bound});
  for (std::uint32_t i = any(6); i > 0; --i)
    plan.tokens.push_back({"t", static_cast<double>(any(1)), any(2), any(2)});
  for (std::uint32_t i = 0; i < 3; ++i)
    if (any(1) == 0) plan.decisions.push_back({"d" + std::to_string(i), "r", {}, any(2)});
  if (any(1) == 0) plan.function_values.push_back({"f", {}, static_cast<double>(any(1)), "o", 1, Time{0}});
  return plan;
}

void expect_same(const FlexiblePlan& plan, const FlexiblePlan& expected) {
  EXPECT_EQ(plan.id, expected.id);
  EXPECT_EQ(plan.version, expected.version);
  EXPECT_EQ(plan.origin, expected.origin);
  EXPECT_EQ(plan.function_values, expected.function_values);
  EXPECT_THAT(plan.activities, UnorderedElementsAreArray(expected.activities));
  EXPECT_THAT(plan.tokens, UnorderedElementsAreArray(expected.tokens));
  EXPECT_THAT(plan.decisions, UnorderedElementsAreArray(expected.decisions));
  EXPECT_THAT(plan.constraints, UnorderedElementsAreArray(expected.constraints));
}

TEST(PlanDelta, LeadsFromEachVersionToTheNext) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    FlexiblePlan plan = random_plan(1, random);
    for (std::uint32_t version = 2; version < 6; ++version) {
      const FlexiblePlan next = random_plan(version, random);
      ASSERT_EQ(apply(difference(plan, next), plan), "");
      expect_same(plan, next);
      if (HasFailure()) return;
    }
  }
}

TEST(PlanDelta, OfEqualPlansIsEmpty) {
  std::mt19937_64 random(2);
  const FlexiblePlan plan = random_plan(3, random);
  const PlanDelta delta = difference(plan, plan);
  EXPECT_THAT(delta.added.activities, IsEmpty());
  EXPECT_THAT(delta.added.constraints, IsEmpty());
  EXPECT_THAT(delta.removed_activities, IsEmpty());
  EXPECT_THAT(delta.removed_tokens, IsEmpty());
}

TEST(PlanDelta, OfNothingIsTheWholePlan) {
  std::mt19937_64 random(3);
  const FlexiblePlan plan = random_plan(3, random);
  FlexiblePlan other = random_plan(7, random);
  EXPECT_EQ(apply(difference({}, plan), other), "");
  EXPECT_EQ(other, plan);
}

TEST(PlanDelta, ThatDoesNotFitChangesNothing) {
  std::mt19937_64 random(4);
  const FlexiblePlan before = random_plan(3, random);
  FlexiblePlan plan = before;
  PlanDelta delta = difference(before, random_plan(4, random));
  delta.from_version = 2;
  EXPECT_THAT(apply(delta, plan), HasSubstr("it changes version 2, the plan is of version 3"));
  delta.from_version = 3;
  delta.removed_activities.push_back("nobody");
  EXPECT_THAT(apply(delta, plan), HasSubstr("removes an activity"));
  delta.removed_activities.pop_back();
  delta.removed_constraints.push_back({9, 9});
  EXPECT_THAT(apply(delta, plan), HasSubstr("removes a constraint"));
  EXPECT_EQ(plan, before);
}

}  // namespace
}  // namespace roci::temporal
