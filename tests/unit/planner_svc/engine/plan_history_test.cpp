// Which versions an engine may still change.
#include "planner_svc/engine/plan_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::planner::engine {
namespace {

using temporal::FlexiblePlan, temporal::PlanDelta;
using ::testing::HasSubstr;

FlexiblePlan plan_of(std::uint32_t version, const std::vector<std::string>& activities) {
  FlexiblePlan plan;
  plan.version = version;
  for (const std::string& id : activities) {
    temporal::PlanActivity activity;
    activity.id = id;
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    plan.activities.push_back(activity);
  }
  return plan;
}

TEST(PlanHistory, AChangeIsAppliedToTheVersionThatItNames) {
  PlanHistory history;
  history.keep(plan_of(1, {"a"}));
  history.keep(plan_of(2, {"a", "b"}));
  const FlexiblePlan third = plan_of(3, {"a", "c"});
  FlexiblePlan next;
  EXPECT_EQ(history.apply(difference(plan_of(1, {"a"}), third), next), "");
  EXPECT_EQ(next, third);
}

TEST(PlanHistory, AWholePlanNeedsNoVersionBefore) {
  const PlanHistory history;
  PlanDelta whole;
  whole.added = plan_of(4, {"a"});
  FlexiblePlan next;
  EXPECT_EQ(history.apply(whole, next), "");
  EXPECT_EQ(next, whole.added);
}

TEST(PlanHistory, WhatIsNotKnownOrForgottenCannotBeChanged) {
  PlanHistory history;
  history.keep(plan_of(1, {"a"}));
  history.keep(plan_of(2, {"b"}));
  history.forget_before(2);
  EXPECT_EQ(history.version(1), nullptr);
  FlexiblePlan next;
  EXPECT_THAT(history.apply(difference(plan_of(1, {"a"}), plan_of(3, {})), next),
              HasSubstr("changes version 1, which is not known"));
  EXPECT_THAT(history.apply(difference(plan_of(2, {"b"}), plan_of(2, {})), next),
              HasSubstr("version 2 does not follow version 2"));
  EXPECT_THAT(history.apply(difference(plan_of(2, {"a"}), plan_of(3, {})), next),
              HasSubstr("removes an activity that the plan has not"));
}

}  // namespace
}  // namespace roci::planner::engine
