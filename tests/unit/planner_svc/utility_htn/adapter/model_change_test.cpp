// Networks and parameters from the ground, taken by the engine between two cycles (R83, R116, R118).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/fit.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "tests/unit/planner_svc/utility_htn/adapter/outlook_fixture.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using engine::ModelChange, engine::StepInputs, engine::StepOutput;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time;
using ::testing::ElementsAre, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;

model::Network lander() {
  return reading::load_network(ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml");
}

model::Task& task(model::Network& network, const std::string& id) {
  return *std::ranges::find(network.tasks, id, &model::Task::id);
}

// Stands in for the executive: takes every version at once.
class ModelChanges : public ::testing::Test {
 protected:
  ModelChanges() {
    StepInputs inputs;
    inputs.goals.push_back(whole_mission());
    step(std::move(inputs));
  }

  static engine::Setup setup() { return {"utility_htn", "lander", "", ""}; }

  StepOutput step(StepInputs inputs) {
    inputs.now = now_;
    inputs.last_version = plan_.version;
    inputs.receipt = engine::Receipt{plan_.version, 0, "", "", true};
    inputs.observations.push_back({"lander.battery", battery_, now_});
    StepOutput out = engine_->step(inputs);
    if (out.delta) {
      EXPECT_EQ(temporal::apply(*out.delta, plan_), "");
    }
    return out;
  }
  void advance(temporal::Duration by) {
    now_ += by;
    step({});
  }
  std::vector<std::string> send(const ModelChange& change) {
    StepInputs inputs;
    inputs.model_changes.push_back(change);
    const StepOutput out = step(std::move(inputs));
    EXPECT_EQ(out.model_answers.size(), 1U);
    return out.model_answers.empty() ? std::vector<std::string>{"no answer"}
                                     : out.model_answers.front().refused;
  }
  std::vector<std::string> send(const model::Network& network) {
    return send({"ground", "n", reading::to_binary(network), "", 0});
  }
  const PlanActivity* planned(const std::string& name) const {
    const auto found = std::ranges::find(plan_.activities, name, &PlanActivity::name);
    return found == plan_.activities.end() ? nullptr : &*found;
  }
  void execute(const std::string& name, ActivityState state, Time started, std::optional<Time> ended) {
    StepInputs inputs;
    engine::StepStatus status;
    status.plan_version = plan_.version;
    status.activity = planned(name)->id;
    status.progress.state = state;
    status.progress.started = started;
    status.progress.ended = ended;
    inputs.steps.push_back(status);
    step(std::move(inputs));
  }

  Time now_ = temporal::seconds(100);
  double battery_ = 600000;
  FlexiblePlan plan_;
  std::unique_ptr<UtilityEngine> engine_ = std::make_unique<UtilityEngine>(setup(), lander());
};

TEST_F(ModelChanges, ANewNetworkIsPlannedAtOnceAndNamedFromThenOn) {
  ASSERT_NE(planned("dig_near"), nullptr);
  const std::uint32_t before = plan_.version;
  model::Network next = lander();
  next.version = 2;
  task(next, "send_view").utility.clear();  // the view is worth nothing any more
  EXPECT_THAT(send(next), IsEmpty());
  EXPECT_EQ(plan_.version, before + 1);
  EXPECT_EQ(planned("send_view"), nullptr);
  EXPECT_NE(planned("send_far"), nullptr);
  EXPECT_EQ(step({}).model, (engine::ModelName{"small-lander", 2}));
}

TEST_F(ModelChanges, AnythingWrongRefusesItWholeAndTheOneInForceGoesOn) {
  model::Network next = lander();
  next.version = 2;
  const std::string good = reading::to_binary(next);
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 4);
  const std::uint32_t before = plan_.version;
  EXPECT_THAT(send({"ground", "n", flipped, "", 0}), ElementsAre(HasSubstr("at byte")));
  EXPECT_THAT(send({"ground", "n", good.substr(0, good.size() / 3), "", 0}),
              ElementsAre(HasSubstr("at byte")));
  EXPECT_THAT(send({"ground", "n", std::string(), "", 0}), Not(IsEmpty()));
  EXPECT_THAT(send(lander()), ElementsAre(HasSubstr("is not newer than version 1")));
  EXPECT_EQ(plan_.version, before);
  EXPECT_EQ(step({}).model, (engine::ModelName{"small-lander", 1}));
}

TEST_F(ModelChanges, WhatIsCommittedStandsInTheNewPlan) {
  advance(temporal::seconds(60));
  const auto committed =
      std::ranges::find(plan_.activities, temporal::CommitState::committed, &PlanActivity::commit);
  ASSERT_NE(committed, plan_.activities.end());
  std::vector<PlanActivity> stand;
  for (const PlanActivity& one : plan_.activities)
    if (one.commit == temporal::CommitState::committed && task_of(one.id)) stand.push_back(one);
  ASSERT_THAT(stand, Not(IsEmpty()));
  model::Network next = lander();
  next.version = 7;
  task(next, "send_near").duration.constant = 200;
  EXPECT_THAT(send(next), IsEmpty());
  for (const PlanActivity& one : stand) {
    const auto now = std::ranges::find(plan_.activities, one.id, &PlanActivity::id);
    ASSERT_NE(now, plan_.activities.end()) << one.id;
    EXPECT_EQ(*now, one);
  }
}

// The ground that wants a site dug all the same asks for it.
TEST_F(ModelChanges, WhatWasGivenUpStaysSoInANewNetwork) {
  std::set<std::string> over;
  int failed = 0;
  for (int i = 0; i < 150; ++i) {
    advance(temporal::seconds(60));
    for (const PlanActivity& one : std::vector(plan_.activities)) {
      const bool due = one.commit == temporal::CommitState::committed && !one.owner.empty() &&
                       plan_.origin + one.preferred_start <= now_;
      if (!due || planned(one.name) == nullptr || !over.insert(one.id).second) continue;
      const bool fails = one.name == "dig_near";
      failed += fails ? 1 : 0;
      execute(one.name, fails ? ActivityState::failed : ActivityState::succeeded, now_,
              now_ + (fails ? temporal::seconds(1) : one.duration_lower));
    }
  }
  ASSERT_EQ(failed, 3);
  ASSERT_EQ(planned("dig_near"), nullptr);
  model::Network next = lander();
  next.version = 2;
  EXPECT_THAT(send(next), IsEmpty());
  EXPECT_EQ(planned("dig_near"), nullptr);
  StepInputs asked;
  asked.goals.push_back(whole_mission());
  asked.goals.back().id = asked.goals.back().kind = "request";
  asked.goals.back().arguments = {{"task", "sample_near"}};
  step(std::move(asked));
  advance(temporal::seconds(60));
  EXPECT_NE(planned("dig_near"), nullptr);
}

TEST_F(ModelChanges, ANetworkWithoutWhatHasBegunIsRefusedWithItsName) {
  advance(temporal::seconds(60));
  const auto committed = std::ranges::find_if(plan_.activities, [](const PlanActivity& one) {
    return one.commit == temporal::CommitState::committed && task_of(one.id);
  });
  ASSERT_NE(committed, plan_.activities.end());
  model::Network next = lander();
  next.version = 2;
  task(next, committed->name).id = "renamed";
  const std::vector<std::string> refused = send(next);
  ASSERT_THAT(refused, Not(IsEmpty()));
  EXPECT_THAT(refused.front(), HasSubstr(committed->name));
  EXPECT_THAT(refused.front(), HasSubstr("has begun and is not in the network"));
  EXPECT_EQ(step({}).model.version, 1U);
}

TEST_F(ModelChanges, AParameterOfTheGroundIsPredictedWith) {
  EXPECT_THAT(send({"ground", "p", std::nullopt, "dig_s_far", 1200}), IsEmpty());
  ASSERT_NE(planned("dig_far"), nullptr);
  EXPECT_EQ(planned("dig_far")->duration_lower, temporal::seconds(1200));
  EXPECT_THAT(send({"ground", "p", std::nullopt, "dig_s_far", 9000}),
              ElementsAre(HasSubstr("the value before stays")));
  EXPECT_THAT(send({"ground", "p", std::nullopt, "dig_s_nowhere", 1}),
              ElementsAre(HasSubstr("no parameter")));
  EXPECT_EQ(planned("dig_far")->duration_lower, temporal::seconds(1200));
}

TEST_F(ModelChanges, ValuesOfTheGroundOutliveANewNetwork) {
  EXPECT_THAT(send({"ground", "p", std::nullopt, "dig_s_far", 1200}), IsEmpty());
  model::Network next = lander();
  next.version = 2;
  EXPECT_THAT(send(next), IsEmpty());
  EXPECT_EQ(planned("dig_far")->duration_lower, temporal::seconds(1200));
}

TEST_F(ModelChanges, APlanOfTheNetworkBeforeIsGoneOnWithAfterARestart) {
  advance(temporal::seconds(60));
  model::Network next = lander();
  next.version = 2;
  for (model::Task& one : next.tasks)
    if (one.id == "sample_far") one.id = "sample_distant";
  UtilityEngine after(setup(), next);
  StepInputs inputs;
  inputs.now = now_ + temporal::seconds(1);
  inputs.goals.push_back(whole_mission());
  inputs.executed = plan_;
  inputs.last_version = plan_.version;
  inputs.receipt = engine::Receipt{plan_.version, 0, "", "", true};
  inputs.observations.push_back({"lander.battery", battery_, inputs.now});
  const StepOutput out = after.step(inputs);
  ASSERT_TRUE(out.delta);
  FlexiblePlan made = plan_;
  ASSERT_EQ(temporal::apply(*out.delta, made), "");
  EXPECT_EQ(std::ranges::count(made.tokens, "sample_far", &temporal::Token::timeline), 0);
  for (const PlanActivity& one : plan_.activities) {
    if (one.commit != temporal::CommitState::committed || !task_of(one.id)) continue;
    EXPECT_NE(std::ranges::find(made.activities, one.id, &PlanActivity::id), made.activities.end()) << one.id;
  }
}

TEST_F(ModelChanges, WhatATaskTookIsPredictedOfItsSiteAndOfNoOther) {
  for (int i = 0; i < 100 && planned("dig_near")->commit != temporal::CommitState::committed; ++i)
    advance(temporal::seconds(60));
  const Time started = now_;
  execute("dig_near", ActivityState::running, started, std::nullopt);
  now_ += temporal::seconds(1000);
  execute("dig_near", ActivityState::succeeded, started, now_);
  advance(temporal::seconds(60));
  const auto remembered = [&](const std::string& name) {
    const auto found = std::ranges::find(plan_.tokens, name, &temporal::Token::timeline);
    return found == plan_.tokens.end() ? std::optional<temporal::Value>() : found->held;
  };
  EXPECT_EQ(remembered("parameter.dig_s_near"), std::optional<temporal::Value>(1000.0));
  EXPECT_EQ(remembered("parameter.dig_s_far"), std::nullopt);
}

TEST_F(ModelChanges, AMeasurementOutOfRangeIsNamedAndNotBelieved) {
  for (int i = 0; i < 100 && planned("dig_near")->commit != temporal::CommitState::committed; ++i)
    advance(temporal::seconds(60));
  const Time started = now_;
  execute("dig_near", ActivityState::running, started, std::nullopt);
  now_ += temporal::seconds(8000);
  StepInputs inputs;
  engine::StepStatus status;
  status.plan_version = plan_.version;
  status.activity = planned("dig_near")->id;
  status.progress = {};
  status.progress.state = ActivityState::succeeded;
  status.progress.started = started;
  status.progress.ended = now_;
  inputs.steps.push_back(status);
  EXPECT_THAT(step(std::move(inputs)).doubted, ElementsAre(HasSubstr("'dig_s_near' would be 8000")));
}

// R109: the flag is internal, since no part of the lander reports it.
class TheWordOfTheGround : public ::testing::Test {
 protected:
  FlexiblePlan plan_after(const std::vector<engine::Observation>& said) const {
    UtilityEngine engine({"utility_htn", "lander", "", ""},
                         reading::load_network(ROCI_SOURCE_DIR "/missions/europa/network-rsm1.yaml"));
    StepInputs inputs;
    inputs.now = temporal::seconds(10);
    inputs.goals.push_back(whole_mission());
    inputs.receipt = engine::Receipt{0, 0, "", "", true};
    inputs.observations = said;
    const StepOutput out = engine.step(inputs);
    FlexiblePlan plan;
    EXPECT_TRUE(out.delta && temporal::apply(*out.delta, plan).empty());
    return plan;
  }
  static std::ptrdiff_t starts(const FlexiblePlan& plan, const std::string& task) {
    return std::ranges::count_if(plan.activities,
                                 [&](const PlanActivity& one) { return one.id.starts_with(task + "#"); });
  }
};

TEST_F(TheWordOfTheGround, OnAnInternalTimelineIsPlannedFor) {
  const FlexiblePlan waits = plan_after({});
  EXPECT_GT(starts(waits, "p_start_nfa"), 0);
  EXPECT_EQ(starts(waits, "p_start"), 0);
  const FlexiblePlan goes = plan_after({{"fully_autonomous", temporal::state("yes"), temporal::seconds(10)}});
  EXPECT_EQ(starts(goes, "p_start_nfa"), 0);
  EXPECT_GT(starts(goes, "p_start"), 0);
}

TEST_F(TheWordOfTheGround, OnAClaimCountsForNothing) {
  const engine::Observation claim{"radio", 1.0, temporal::seconds(10)};
  EXPECT_EQ(plan_after({claim}), plan_after({}));
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
