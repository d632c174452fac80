// An engine whose process died goes on from the plan that is executed, with all that was reported before (R81).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using engine::Observation, engine::StepInputs, engine::StepOutput;
using temporal::FlexiblePlan, temporal::Time;
using ::testing::Contains;
using ::testing::Not;

UtilityEngine new_engine() { return {{"utility_htn", "lander", "", {}}, testing::toy_network()}; }

StepInputs beginning() {
  StepInputs out;
  out.receipt = engine::Receipt{0, 0, "", "", true};
  engine::Goal mission;
  mission.issuer = "ground";
  mission.id = mission.kind = "mission";
  out.goals.push_back(mission);
  return out;
}

// Returns the names of what the version after a restart does, in order.
std::vector<std::string> tasks_after_restart(const std::vector<Observation>& reported,
                                             bool in_a_step_before) {
  UtilityEngine died = new_engine();
  FlexiblePlan plan;
  EXPECT_EQ(temporal::apply(*died.step(beginning()).delta, plan), "");

  UtilityEngine anew = new_engine();
  StepInputs inputs = beginning();
  inputs.now = Time(6s);
  inputs.observations = reported;
  if (in_a_step_before) {
    StepInputs before;
    before.now = inputs.now;
    std::swap(before.observations, inputs.observations);
    anew.step(before);
  }
  inputs.executed = plan;
  inputs.receipt->version = inputs.last_version = plan.version;
  const StepOutput out = anew.step(inputs);
  if (out.delta) {
    EXPECT_EQ(temporal::apply(*out.delta, plan), "");
  }
  std::vector<std::string> names;
  for (const temporal::PlanActivity& activity : plan.activities) names.push_back(activity.name);
  std::ranges::sort(names);
  return names;
}

TEST(RestartedEngine, KnowsWhatWasReportedBeforeItsRestartHoweverItHearsIt) {
  const std::vector<Observation> reported{{"battery", 100.0, Time(5s)}};
  ASSERT_THAT(tasks_after_restart({}, false), Contains("send_sample"));
  EXPECT_THAT(tasks_after_restart(reported, true), Not(Contains("send_sample")));
  EXPECT_THAT(tasks_after_restart(reported, false), Not(Contains("send_sample")))
      << "with the executed version";
}

// The timelines that nobody reports stand in the plan as they were when it was sent; what ended later moved them, too.
TEST(RestartedEngine, KnowsWhatATaskHasMadeOfATimelineSinceTheVersionThatIsExecuted) {
  UtilityEngine died = new_engine();
  FlexiblePlan plan;
  ASSERT_EQ(temporal::apply(*died.step(beginning()).delta, plan), "");
  const auto dig = std::ranges::find(plan.activities, "dig", &temporal::PlanActivity::name);
  ASSERT_NE(dig, plan.activities.end());

  UtilityEngine anew = new_engine();
  StepInputs inputs = beginning();
  inputs.now = Time(200s);
  inputs.executed = plan;
  inputs.receipt->version = inputs.last_version = plan.version;
  inputs.steps.push_back(
      {plan.version, dig->id, {temporal::ActivityState::succeeded, Time(5s), Time(105s)}, "", 1});
  const StepOutput out = anew.step(inputs);
  ASSERT_TRUE(out.delta);
  ASSERT_EQ(temporal::apply(*out.delta, plan), "");
  const auto site = std::ranges::find(plan.tokens, "internal.site", &temporal::Token::timeline);
  ASSERT_NE(site, plan.tokens.end());
  EXPECT_EQ(temporal::to_text(site->held), "open");
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
