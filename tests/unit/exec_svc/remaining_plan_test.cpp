// What is left of a plan goes with the next planner call.
#include "exec_svc/reactor/remaining_plan.hpp"

#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::StepStatus;
using mission::Replanning;
using reactor::planned_actions;
using reactor::PlannedAction;
using reactor::PlanReply;
using reactor::PlanRequest;
using reactor::Reactor;
using reactor::ReactorInputs;
using reactor::ReactorOutputs;
using reactor::remaining_actions;
using temporal::Verdict;

namespace {

using temporal::ActivityState;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> text_of(const std::vector<PlannedAction>& actions) {
  std::vector<std::string> out;
  for (const PlannedAction& action : actions) {
    std::string text = action.name;
    for (const std::string& argument : action.arguments) text += " " + argument;
    out.push_back(std::move(text));
  }
  return out;
}

TEST(RemainingPlan, ActionsStandAsThePlannerWroteThemAtTheirEarliest) {
  const auto actions = planned_actions(images({"1", "2"}));
  EXPECT_THAT(text_of(actions), ElementsAre("take-image image-1 place-1", "take-image image-2 place-2"));
  EXPECT_EQ(actions[0].start, seconds(0));
  EXPECT_EQ(actions[0].duration, seconds(40));
  EXPECT_EQ(actions[1].start, seconds(40.001));
}

TEST(RemainingPlan, WhatRunsOrHasDoneItsWorkIsLeftOut) {
  std::vector<PlannedAction> planned;
  std::vector<StepStatus> steps;
  for (const ActivityState state :
       {ActivityState::waiting, ActivityState::dispatched, ActivityState::running, ActivityState::succeeded,
        ActivityState::failed, ActivityState::skipped, ActivityState::cancelled}) {
    StepStatus step;
    step.activity = std::to_string(static_cast<int>(state));
    step.state = state;
    planned.push_back({step.activity, "act-" + step.activity, {}, {}, {}});
    steps.push_back(std::move(step));
  }
  planned.push_back({"untold", "act-untold", {}, {}, {}});
  EXPECT_THAT(text_of(remaining_actions(planned, steps)),
              ElementsAre("act-0", "act-4", "act-6", "act-untold"));
  EXPECT_EQ(remaining_actions(planned, {}), planned);
}

class Replanning : public ReactorTest {
 protected:
  Replanning() {
    planner = [this](const PlanRequest& call) {
      remaining.push_back(text_of(call.remaining));
      return image_every_goal(call);
    };
  }

  // The first image runs from 100 s to 140 s.
  void fly_with_a_goal_at(double time_s) {
    other_events.emplace(seconds(time_s), [this] { pending.goals.push_back(photo("3")); });
    run(time_s + 1, robot_and({photo("1"), photo("2")}));
  }

  std::vector<std::vector<std::string>> remaining;  // of each call
};

TEST_F(Replanning, BeginsWithWhatIsLeft) {
  fly_with_a_goal_at(60);
  ASSERT_EQ(remaining.size(), 2U);
  EXPECT_THAT(remaining[0], IsEmpty());
  EXPECT_THAT(remaining[1], ElementsAre("take-image image-2 place-2"));
}

TEST_F(Replanning, WhatWasCancelledIsStillToBeDone) {
  fly_with_a_goal_at(20);
  ASSERT_EQ(remaining.size(), 2U);
  EXPECT_THAT(remaining[1], ElementsAre("take-image image-1 place-1", "take-image image-2 place-2"));
}

TEST_F(Replanning, ACallThatIsMadeAgainBeginsLikewise) {
  const Planner solves = planner;
  planner = [&, calls = 0](const PlanRequest& call) mutable {
    PlanReply out = solves(call);
    if (++calls > 1 && calls < 4) out = reply(Verdict::crashed, "no luck");
    return out;
  };
  other_events.emplace(seconds(60), [this] { pending.goals.push_back(photo("3")); });
  run(500, robot_and({photo("1"), photo("2")}));
  ASSERT_EQ(remaining.size(), 4U);
  remaining.erase(remaining.begin());
  EXPECT_THAT(remaining, Each(ElementsAre("take-image image-2 place-2")));
}

// The snapshot has no plan in it, and still the call after it begins with what was left.
TEST_F(Replanning, AfterARestartToo) {
  const Planner solves = planner;
  planner = [&](const PlanRequest& call) {
    PlanReply out = solves(call);
    return remaining.size() == 1 ? out : reply(Verdict::crashed, "no luck");
  };
  fly_with_a_goal_at(60);
  ASSERT_EQ(remaining.size(), 2U);
  ASSERT_TRUE(reactor.at_rest());
  Reactor restarted(mission);
  restarted.restore(reactor.snapshot());
  ReactorInputs inputs;
  inputs.restarted = true;
  std::vector<std::string> begun_with;
  for (double time_s = 61; time_s < 200 && begun_with.empty(); ++time_s) {
    const ReactorOutputs out = restarted.step(seconds(time_s), std::exchange(inputs, {}));
    if (out.call) begun_with = text_of(out.call->remaining);
  }
  EXPECT_THAT(begun_with, ElementsAre("take-image image-2 place-2"));
}

}  // namespace
}  // namespace roci::exec::testing
