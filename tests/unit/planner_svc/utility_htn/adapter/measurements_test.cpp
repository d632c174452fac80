// What is measured reaches the predictions: the executive's word on the step and the owner's on each command,
// in any order (R101, R116).
#include "planner_svc/utility_htn/adapter/measurements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using engine::CommandResult, engine::StepInputs, engine::StepOutput, engine::StepStatus;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time;
using ::testing::ElementsAre, ::testing::HasSubstr, ::testing::IsEmpty;

// Task 0 has one command, task 1 a sequence of two; both learn all there is.
model::Network two_tasks() {
  model::Network out;
  out.parameters.resize(3);
  for (const std::size_t commands : {1U, 2U}) {
    model::Task& task = out.tasks.emplace_back();
    task.id = commands == 1 ? "dig" : "analyze";
    task.commands.resize(commands);
    task.learns = {{model::Measure::duration_s, 0, {}},
                   {model::Measure::power, 1, {}},
                   {model::Measure::value, 2, "worth"}};
  }
  return out;
}

StepStatus succeeded(const std::string& activity, std::uint32_t attempt) {
  StepStatus out;
  out.activity = activity;
  out.attempt = attempt;
  out.progress = {ActivityState::succeeded, temporal::seconds(100), temporal::seconds(300)};
  return out;
}

CommandResult result(const std::string& activity, std::uint32_t attempt, std::optional<double> energy_j,
                     double worth) {
  return {activity, attempt, energy_j, {{"worth", worth}}};
}

class MeasurementsTest : public ::testing::Test {
 protected:
  // Durations that were given out, then powers and values.
  std::vector<double> take() {
    std::vector<double> out;
    for (const Measurements::Measurement& one : measurements_.take(network_)) {
      if (one.measured.duration_s) out.push_back(*one.measured.duration_s);
      if (one.measured.power) out.push_back(*one.measured.power);
      if (one.measured.values) out.push_back(one.measured.values->at("worth"));
    }
    return out;
  }

  model::Network network_ = two_tasks();
  Measurements measurements_;
};

TEST_F(MeasurementsTest, ArePutTogetherWhicheverWordComesFirst) {
  measurements_.hear(succeeded("dig#1.0", 1));
  EXPECT_THAT(take(), ElementsAre(200));
  EXPECT_THAT(measurements_.taken(), IsEmpty()) << "the owner has not said yet";
  measurements_.hear(result("dig#1.0", 1, 8000, 0.5));
  EXPECT_THAT(take(), ElementsAre(40, 0.5));
  EXPECT_THAT(take(), IsEmpty()) << "each is given out once";
  EXPECT_THAT(measurements_.taken(), ElementsAre("dig#1.0"));
  measurements_.hear(result("dig#2.0", 1, 6000, 0.7));
  EXPECT_THAT(take(), IsEmpty()) << "the step has not ended";
  measurements_.hear(succeeded("dig#2.0", 1));
  EXPECT_THAT(take(), ElementsAre(200, 30, 0.7));
}

TEST_F(MeasurementsTest, OfSeveralAttemptsTheOneThatSucceededCounts) {
  measurements_.hear(result("dig#1.0", 1, 50'000, 0.1));
  measurements_.hear(succeeded("dig#1.0", 2));
  EXPECT_THAT(take(), IsEmpty()) << "the 200 s hold the first attempt";
  measurements_.hear(result("dig#1.0", 2, 8000, 0.5));
  EXPECT_THAT(take(), ElementsAre(0.5)) << "neither does a power follow";
  EXPECT_THAT(measurements_.taken(), ElementsAre("dig#1.0"));
}

TEST_F(MeasurementsTest, OfASequenceAllCommandsCountAndOfTwoValuesTheLater) {
  measurements_.hear(result("analyze#1.0", 1, 2000, 0.2));
  measurements_.hear(succeeded("analyze#1.0", 2));
  EXPECT_THAT(take(), ElementsAre(200)) << "its second command is no second attempt";
  measurements_.hear(result("analyze#1.0", 2, 1000, 0.3));
  EXPECT_THAT(take(), ElementsAre(15, 0.3));
}

TEST_F(MeasurementsTest, OfASequenceThatIsTriedAgainTheLastCommandsCount) {
  measurements_.hear(
      result("analyze#1.0", 1, 70'000, 0.1));  // the first attempt failed at its second command
  measurements_.hear(result("analyze#1.0", 3, 2000, 0.2));
  measurements_.hear(succeeded("analyze#1.0", 4));
  EXPECT_THAT(take(), IsEmpty());
  measurements_.hear(result("analyze#1.0", 4, 1000, 0.3));
  EXPECT_THAT(take(), ElementsAre(0.3));
}

// An engine that is made anew is not told again with which attempt an activity ended.
TEST_F(MeasurementsTest, WhereTheExecutiveDoesNotTellTheAttemptTheOwnerDoes) {
  measurements_.hear(result("dig#1.0", 2, 8000, 0.5));
  measurements_.hear(succeeded("dig#1.0", 0));
  EXPECT_THAT(take(), ElementsAre(0.5));
}

TEST_F(MeasurementsTest, WithoutAMeasuredEnergyNoPowerFollows) {
  measurements_.hear(succeeded("dig#1.0", 1));
  measurements_.hear(result("dig#1.0", 1, std::nullopt, 0.5));
  EXPECT_THAT(take(), ElementsAre(200, 0.5));
}

TEST_F(MeasurementsTest, WhatAnotherProcessTookIsNotTakenAgain) {
  measurements_.resume({"dig#1.0"});
  for (const char* activity : {"dig#1.0", "dig#2.0"}) {
    measurements_.hear(succeeded(activity, 1));
    measurements_.hear(result(activity, 1, 8000, 0.5));
  }
  EXPECT_THAT(take(), ElementsAre(200, 40, 0.5));
  measurements_.keep_only([](const std::string& activity) { return activity == "dig#2.0"; });
  EXPECT_THAT(measurements_.taken(), ElementsAre("dig#2.0"));
}

// The small lander, whose sites have a power and a value of their own; stands in for the executive,
// which takes every version at once.
class LearnedInFlight : public ::testing::Test {
 protected:
  LearnedInFlight() { begin(); }

  static model::Network lander() {
    model::Network out = reading::load_network(ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml");
    for (model::Task& task : out.tasks) {
      if (!task.id.starts_with("dig_")) continue;
      const auto index = [&] { return static_cast<model::ParameterIndex>(out.parameters.size() - 1); };
      out.parameters.push_back({task.id + "_w", 150, 10, 1000, "chosen"});
      for (model::Impact& impact : task.impacts)
        if (impact.kind == temporal::ImpactKind::rate) impact.amount = {0, index(), -1};
      task.learns.push_back({model::Measure::power, index(), {}});
      out.parameters.push_back({task.id + "_worth", 0.5, 0, 1, "chosen"});
      task.learns.push_back({model::Measure::value, index(), "worth"});
    }
    return out;
  }

  void begin() {
    engine_ = std::make_unique<UtilityEngine>(engine::Setup{"utility_htn", "lander", "", ""}, lander());
    StepInputs inputs;
    engine::Goal mission;
    mission.issuer = "ground";
    mission.id = mission.kind = "mission";
    inputs.goals.push_back(mission);
    if (plan_.version != 0) inputs.executed = plan_;
    inputs.steps = steps_;
    inputs.results = results_;
    step(std::move(inputs));
  }

  StepOutput step(StepInputs inputs) {
    inputs.now = now_;
    inputs.last_version = plan_.version;
    inputs.receipt = engine::Receipt{plan_.version, 0, "", "", true};
    inputs.observations.push_back({"lander.battery", 600'000.0, now_});
    StepOutput out = engine_->step(inputs);
    if (out.delta) {
      EXPECT_EQ(temporal::apply(*out.delta, plan_), "");
    }
    return out;
  }

  std::string planned(const std::string& name) const {
    const auto found = std::ranges::find(plan_.activities, name, &PlanActivity::name);
    return found == plan_.activities.end() ? "" : found->id;
  }

  // Digs the near site within 1,000 s with 200 W; what is said of it stays to be heard again.
  void dig(double worth = 0.9) {
    for (int i = 0; i < 100 && !is_committed("dig_near"); ++i) {
      now_ += temporal::seconds(60);
      step({});
    }
    StepStatus status;
    status.activity = planned("dig_near");
    status.attempt = 1;
    status.progress = {ActivityState::succeeded, now_, now_ + temporal::seconds(1000)};
    steps_ = {status};
    results_ = {{status.activity, 1, 200'000, {{"worth", worth}}}};
    now_ += temporal::seconds(1000);
  }
  bool is_committed(const std::string& name) const {
    const auto found = std::ranges::find(plan_.activities, name, &PlanActivity::name);
    return found != plan_.activities.end() && found->commit == temporal::CommitState::committed;
  }

  StepOutput hear() {
    StepInputs inputs;
    inputs.steps = steps_;
    inputs.results = results_;
    return step(std::move(inputs));
  }

  std::optional<temporal::Value> remembered(const std::string& name) const {
    const auto found = std::ranges::find(plan_.tokens, "parameter." + name, &temporal::Token::timeline);
    return found == plan_.tokens.end() ? std::nullopt : std::optional(found->held);
  }

  void expect_learned() const {
    EXPECT_EQ(remembered("dig_s_near"), std::optional<temporal::Value>(1000.0));
    EXPECT_EQ(remembered("dig_near_w"), std::optional<temporal::Value>(200.0));
    EXPECT_EQ(remembered("dig_near_worth"), std::optional<temporal::Value>(0.9));
    for (const char* far : {"dig_s_far", "dig_far_w", "dig_far_worth"})
      EXPECT_EQ(remembered(far), std::nullopt);
  }

  Time now_ = temporal::seconds(100);
  FlexiblePlan plan_;
  std::vector<StepStatus> steps_;
  std::vector<CommandResult> results_;
  std::unique_ptr<UtilityEngine> engine_;
};

TEST_F(LearnedInFlight, DurationPowerAndValueStandInThePlanOfTheNextCycle) {
  dig();
  EXPECT_THAT(hear().doubted, IsEmpty());
  now_ += temporal::seconds(60);
  step({});
  expect_learned();
}

TEST_F(LearnedInFlight, WhatIsOutOfRangeIsNamedAndTheRestIsLearned) {
  dig(1.5);
  EXPECT_THAT(hear().doubted,
              ElementsAre(HasSubstr("the value 'worth' 1.5 of 'dig_near' is not taken over")));
  now_ += temporal::seconds(60);
  step({});
  EXPECT_EQ(remembered("dig_near_w"), std::optional<temporal::Value>(200.0));
  EXPECT_EQ(remembered("dig_near_worth"), std::nullopt);
}

TEST_F(LearnedInFlight, WhatEndedWhileTheEngineWasDeadIsLearnedByTheNextOne) {
  dig();
  begin();
  now_ += temporal::seconds(60);
  step({});
  expect_learned();
}

// What the ground says of a site after it was measured counts more than the measurement,
// which the next process hears again.
TEST_F(LearnedInFlight, ALaterWordOfTheGroundOutlivesTheEngineToo) {
  dig();
  hear();
  now_ += temporal::seconds(60);
  StepInputs ground;
  ground.model_changes.push_back({"ground", "p", std::nullopt, "dig_s_near", 1300});
  EXPECT_THAT(step(std::move(ground)).model_answers,
              ElementsAre(::testing::Field(&engine::ModelAnswer::refused, IsEmpty())));
  ASSERT_EQ(remembered("dig_s_near"), std::optional<temporal::Value>(1300.0));
  begin();
  now_ += temporal::seconds(60);
  step({});
  EXPECT_EQ(remembered("dig_s_near"), std::optional<temporal::Value>(1300.0));
  EXPECT_EQ(remembered("dig_near_w"), std::optional<temporal::Value>(200.0));
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
