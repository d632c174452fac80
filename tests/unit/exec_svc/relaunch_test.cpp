// R149: what goes with activities that the ground drops from a plan of several levels.
#include "exec_svc/reactor/relaunch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::exec::reactor {
namespace {

using executive::StepStatus;
using temporal::ActivityState;
using temporal::FlexiblePlan;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

// traverse {cycle {look, drive}, other}, report {send}, and a step of no level.
FlexiblePlan levels() {
  FlexiblePlan plan;
  const auto add = [&](const char* id, const char* parent, const char* owner) {
    temporal::PlanActivity activity;
    activity.id = id;
    activity.parent = parent;
    activity.owner = owner;
    plan.activities.push_back(activity);
  };
  add("traverse", "", "");
  add("cycle", "traverse", "");
  add("look", "cycle", "eye");
  add("drive", "cycle", "nav");
  add("other", "traverse", "nav");
  add("report", "", "");
  add("send", "report", "antenna");
  add("alone", "", "nav");
  return plan;
}

std::vector<StepStatus> steps_of(const FlexiblePlan& plan) {
  std::vector<StepStatus> out;
  for (const temporal::PlanActivity& activity : plan.activities) {
    StepStatus step;
    step.activity = activity.id;
    step.state = ActivityState::waiting;
    out.push_back(step);
  }
  return out;
}

StepStatus& step(std::vector<StepStatus>& steps, const std::string& activity) {
  return *std::ranges::find(steps, activity, &StepStatus::activity);
}

TEST(Relaunch, WhatHasNoPartLeftIsLeftOut) {
  const FlexiblePlan plan = levels();
  std::vector<StepStatus> steps = steps_of(plan);
  EXPECT_THAT(left_out(plan, steps, {"send"}), UnorderedElementsAre("send", "report"));
  EXPECT_THAT(left_out(plan, steps, {"look"}), UnorderedElementsAre("look")) << "the cycle still drives";
  EXPECT_THAT(left_out(plan, steps, {"look", "drive"}), UnorderedElementsAre("look", "drive", "cycle"));
  EXPECT_THAT(left_out(plan, steps, {"alone"}), UnorderedElementsAre("alone"));
  EXPECT_THAT(left_out(plan, steps, {}), IsEmpty());

  step(steps, "other").state = ActivityState::skipped;
  EXPECT_THAT(left_out(plan, steps, {"look", "drive"}),
              UnorderedElementsAre("other", "look", "drive", "cycle", "traverse"))
      << "a choice that was not taken is no part that is left";
  EXPECT_THAT(left_out(plan, steps, {"send"}), UnorderedElementsAre("other", "send", "report"));
}

TEST(Relaunch, WhatIsDroppedIsDroppedWithItsParts) {
  const FlexiblePlan plan = levels();
  std::vector<StepStatus> steps = steps_of(plan);
  EXPECT_THAT(left_out(plan, steps, {"cycle"}), UnorderedElementsAre("cycle", "look", "drive"));
  EXPECT_THAT(left_out(plan, steps, {"report"}), UnorderedElementsAre("report", "send"));
  step(steps, "look").state = ActivityState::succeeded;
  EXPECT_THAT(left_out(plan, steps, {"cycle"}), UnorderedElementsAre("cycle", "drive"))
      << "what is done is done";
}

TEST(Relaunch, WhatHasBegunKeepsItsLastPart) {
  const FlexiblePlan plan = levels();
  std::vector<StepStatus> steps = steps_of(plan);
  EXPECT_EQ(drop_fault(plan, steps, {"send"}), "");
  step(steps, "report").state = ActivityState::running;
  step(steps, "report").started = temporal::seconds(5);
  EXPECT_THAT(drop_fault(plan, steps, {"send"}),
              HasSubstr("nothing of report would be left, which has begun"));
  EXPECT_EQ(drop_fault(plan, steps, {"look"}), "");
}

}  // namespace
}  // namespace roci::exec::reactor
