// Stands in for the executive and the host of an engine whose downlinks have a limit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/checking/schedule_checker.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::adapter {

// The small lander; `image_SITE` makes 1,000 bytes and a downlink of 300 s carries 3,000.
inline model::Network imaging_lander() {
  model::Network out = reading::load_network(ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml");
  if (std::ranges::find(out.parameters, "rate_bytes_per_s", &model::Parameter::name) == out.parameters.end())
    out.parameters.push_back({"rate_bytes_per_s", 10, 0, 1e9});
  std::ranges::find(out.parameters, "rate_bytes_per_s", &model::Parameter::name)->prior = 10;
  for (model::Task& task : out.tasks) {
    task.products.clear();
    if (task.id.starts_with("image_")) task.products = {{"picture", model::Tier::mandatory, {1000}, {0.3}}};
  }
  return out;
}

inline engine::Goal whole_mission() {
  engine::Goal out;
  out.issuer = "ground";
  out.id = "network";
  out.kind = "mission";
  return out;
}

// What the engine tells is right for the independent checker, too.
class OutlookTest : public ::testing::Test {
 protected:
  void start(model::Network network = imaging_lander(), cycle::Settings settings = {}) {
    network_ = network;
    engine_ = std::make_unique<UtilityEngine>(engine::Setup{"utility_htn", "lander", "", ""},
                                              std::move(network), settings);
    engine::StepInputs inputs;
    inputs.goals.push_back(whole_mission());
    step(std::move(inputs));
  }

  engine::StepOutput step(engine::StepInputs inputs = {}) {
    inputs.now = now_;
    inputs.last_version = plan_.version;
    inputs.receipt = engine::Receipt{plan_.version, 0, "", "", true};
    if (battery_) inputs.observations.push_back({"lander.battery", *battery_, now_});
    engine::StepOutput out = engine_->step(inputs);
    EXPECT_EQ(checker_.faults(network_, inputs, out), std::vector<std::string>{});
    if (out.delta) {
      EXPECT_EQ(temporal::apply(*out.delta, plan_), "");
    }
    if (out.schedule) schedule_ = *out.schedule;
    if (out.outlook) outlook_ = *out.outlook;
    told_ += (out.schedule ? 1 : 0) + (out.outlook ? 1 : 0);
    return out;
  }
  void advance_to(temporal::Time when) {
    now_ = when;
    step();
  }
  std::string activity(const std::string& task) const {
    const auto found = std::ranges::find(plan_.activities, task, &temporal::PlanActivity::name);
    return found == plan_.activities.end() ? "none of " + task : found->id;
  }
  void execute(const std::string& id, temporal::ActivityState state, temporal::Time started, std::optional<temporal::Time> ended) {
    engine::StepInputs inputs;
    engine::StepStatus status;
    status.plan_version = plan_.version;
    status.activity = id;
    status.progress.state = state;
    status.progress.started = started;
    status.progress.ended = ended;
    inputs.steps.push_back(status);
    step(std::move(inputs));
  }
  void hear(engine::DataProduct product) {
    engine::StepInputs inputs;
    inputs.products.push_back(std::move(product));
    step(std::move(inputs));
  }
  engine::DataProduct picture(const std::string& id, const std::string& source) const {
    engine::DataProduct out;
    out.id = id;
    out.kind = "picture";
    out.source = source;
    out.bytes = 900;
    out.created = now_;
    return out;
  }
  const engine::ScheduledDownlink* downlink(const std::string& task) const {
    const auto found = std::ranges::find_if(schedule_.downlinks, [&](const engine::ScheduledDownlink& one) {
      return one.activity.starts_with(task + "#");
    });
    return found == schedule_.downlinks.end() ? nullptr : &*found;
  }
  const engine::ChainOutlook& chain(const std::string& request) const {
    return *std::ranges::find(outlook_.chains, request, &engine::ChainOutlook::request);
  }

  temporal::Time now_ = temporal::seconds(100);
  std::optional<double> battery_ = 600000;
  temporal::FlexiblePlan plan_;
  model::Network network_;
  checking::ScheduleChecker checker_;
  std::unique_ptr<UtilityEngine> engine_;
  engine::DownlinkSchedule schedule_;
  engine::MissionOutlook outlook_;
  int told_ = 0;
};

}  // namespace roci::planner::utility_htn::adapter
