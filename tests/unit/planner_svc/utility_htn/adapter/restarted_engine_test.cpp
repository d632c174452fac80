// An engine whose process died goes on from the plan that is executed, with all that was reported before (R81).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

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

// The process before it died before any version was executed; what was reported then is not reported again.
TEST(RestartedEngine, KnowsWhatWasReportedBeforeItBegan) {
  StepInputs inputs = beginning();
  inputs.now = Time(6s);
  inputs.observations = {{"battery", 200.0, Time(1s)}};
  const StepOutput out = new_engine().step(inputs);
  ASSERT_TRUE(out.delta);
  FlexiblePlan plan;
  ASSERT_EQ(temporal::apply(*out.delta, plan), "");
  const auto has = [&](const std::string& name) {
    return std::ranges::find(plan.activities, name, &temporal::PlanActivity::name) != plan.activities.end();
  };
  EXPECT_TRUE(has("send_view"));
  EXPECT_FALSE(has("send_sample")) << "which takes 350 J";
}

// Two activities of one name would have one key, and the owner would answer for the second what became of the first.
TEST(RestartedEngine, GivesNoNumberOfABlockAgain) {
  UtilityEngine died = new_engine();
  FlexiblePlan plan;
  ASSERT_EQ(temporal::apply(*died.step(beginning()).delta, plan), "");
  std::set<std::string> used;
  for (const temporal::PlanActivity& activity : plan.activities) used.insert(activity.id);
  ASSERT_THAT(used, ::testing::SizeIs(::testing::Gt(4U)));
  // All but the first block is over and has left the plan.
  const auto is_first = [](const temporal::PlanActivity& one) {
    return one.id.find("#1.") != std::string::npos;
  };
  std::erase_if(plan.activities, std::not_fn(is_first));
  ASSERT_THAT(plan.activities, Not(::testing::IsEmpty()));
  std::erase_if(plan.tokens, [](const temporal::Token& one) {
    return one.start_point != temporal::origin_point &&
           std::get<temporal::State>(one.held).arguments.front() != "1";
  });
  for (const bool executed : {true, false}) {
    UtilityEngine anew = new_engine();
    StepInputs inputs = beginning();
    inputs.now = Time(6s);
    inputs.receipt->version = executed ? plan.version : 0;
    inputs.last_version = plan.version;
    if (executed) inputs.executed = plan;
    const StepOutput out = anew.step(inputs);
    ASSERT_TRUE(out.delta);
    int added = 0;
    for (const temporal::PlanActivity& activity : out.delta->added.activities) {
      if (is_first(activity) && executed) continue;
      EXPECT_FALSE(used.contains(activity.id)) << activity.id;
      ++added;
    }
    EXPECT_GE(added, 3);
  }
}

// One downlink takes 100 J, and a sol has 150 J for all of them.
TEST(RestartedEngine, KnowsWhatDownlinksTookThatHaveLeftThePlan) {
  model::Network network = testing::toy_network();
  for (const auto& [name, value] : {std::pair("rate_bytes_per_s", 10.0), {"sol_limit_j", 150.0}, {"sol_s", 1e6}})
    network.parameters.push_back({name, value, 0, 1e9});
  for (const char* id : {"send_sample", "send_view"})
    network.tasks[testing::task_named(network, id)].downlinks = true;
  network.tasks[testing::task_named(network, "idle")].opens = 2000s;  // so that the plan goes on
  const auto engine = [&] { return UtilityEngine({"utility_htn", "lander", "", {}}, network); };
  const auto names = [](const FlexiblePlan& plan) {
    std::vector<std::string> out;
    for (const temporal::PlanActivity& activity : plan.activities) out.push_back(activity.name);
    return out;
  };
  UtilityEngine died = engine();
  FlexiblePlan plan;
  ASSERT_EQ(temporal::apply(*died.step(beginning()).delta, plan), "");
  ASSERT_THAT(names(plan), Contains("send_sample"));
  ASSERT_THAT(names(plan), Not(Contains("send_view")));
  std::set<std::string> over;
  for (Time now = 10s; now < 600s; now += 10s) {
    StepInputs inputs;
    inputs.now = now;
    inputs.receipt = engine::Receipt{plan.version, 0, "", "", true};
    inputs.last_version = plan.version;
    for (const temporal::PlanActivity& one : plan.activities) {
      const Time start = plan.origin + one.preferred_start, end = start + one.duration_lower;
      if (one.commit != temporal::CommitState::committed || end > now || !over.insert(one.id).second) continue;
      inputs.steps.push_back({plan.version, one.id, {temporal::ActivityState::succeeded, start, end}, "", 0});
    }
    const StepOutput out = died.step(inputs);
    if (out.delta) {
      ASSERT_EQ(temporal::apply(*out.delta, plan), "");
    }
  }
  ASSERT_THAT(names(plan), Not(Contains("send_sample"))) << "it is over";
  ASSERT_THAT(names(plan), Not(Contains("send_view")));
  for (int restart = 0; restart < 2; ++restart) {
    UtilityEngine anew = engine();
    StepInputs inputs = beginning();
    inputs.now = Time(600s + restart * 100s);
    inputs.executed = plan;
    inputs.receipt->version = inputs.last_version = plan.version;
    const StepOutput out = anew.step(inputs);
    if (out.delta) {
      ASSERT_EQ(temporal::apply(*out.delta, plan), "");
    }
    EXPECT_THAT(names(plan), Not(Contains("send_view"))) << "after restart " << restart;
  }
}

// A cycle may take longer than its interval; here three have passed until the engine is stepped again.
TEST(LateCycle, LeavesOutTheIntervalsThatHavePassed) {
  UtilityEngine engine = new_engine();
  EXPECT_EQ(engine.step(beginning()).wake, Time(10s));
  StepInputs late;
  late.now = Time(35s);
  late.observations = {{"battery", 900.0, Time(35s)}};
  const StepOutput out = engine.step(late);
  EXPECT_THAT(out.account.parts, Contains("commit")) << "the report alone brings about a cycle";
  EXPECT_EQ(out.wake, Time(40s));
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

// Such a template is nobody's goal; here it waits for a battery that holds more than was reported.
TEST(RestartedEngine, KnowsWhatAContingencyHasRequested) {
  const auto make = [] {
    model::Network network = testing::toy_network();
    const model::TaskIndex image = testing::task_named(network, "image");
    network.tasks[image].utility = {{1}};
    network.tasks[testing::task_named(network, "dig")].contingency = {.requests = {image}};
    return UtilityEngine({"utility_htn", "lander", "", {}}, std::move(network));
  };
  const auto images = [](const FlexiblePlan& plan) {
    return std::ranges::count(plan.tokens, "image", &temporal::Token::timeline);
  };
  UtilityEngine died = make();
  FlexiblePlan plan;
  ASSERT_EQ(temporal::apply(*died.step(beginning()).delta, plan), "");
  const auto dig = std::ranges::find(plan.activities, "dig", &temporal::PlanActivity::name);
  ASSERT_NE(dig, plan.activities.end());
  StepInputs failed;
  failed.now = Time(20s);
  failed.receipt = engine::Receipt{plan.version, 0, "", "", true};
  failed.steps.push_back(
      {plan.version, dig->id, {temporal::ActivityState::failed, Time(5s), Time(15s)}, "too hard", 1});
  failed.observations = {{"battery", 1.0, Time(15s)}};
  ASSERT_EQ(temporal::apply(*died.step(failed).delta, plan), "");
  ASSERT_EQ(images(plan), 0);

  UtilityEngine anew = make();
  StepInputs inputs = beginning();
  inputs.now = Time(30s);
  inputs.executed = plan;
  inputs.receipt->version = inputs.last_version = plan.version;
  inputs.observations = {{"battery", 900.0, Time(29s)}};
  if (const StepOutput out = anew.step(inputs); out.delta) {
    EXPECT_EQ(temporal::apply(*out.delta, plan), "");
  }
  EXPECT_EQ(images(plan), 1);
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
