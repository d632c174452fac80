// This is the utility-driven engine as planner_svc steps it (R66, R77–R81): it hears observations, goals and what
// became of tasks, runs its cycle at the process interval, and sends versions of its plan.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/measurements.hpp"
#include "planner_svc/utility_htn/adapter/open_goals.hpp"
#include "planner_svc/utility_htn/adapter/planned_network.hpp"
#include "planner_svc/utility_htn/adapter/published_plan.hpp"
#include "planner_svc/utility_htn/adapter/told_outlook.hpp"

namespace roci::planner::utility_htn::adapter {

/// Plans the network that is the mission's model. A goal of kind `request` asks for the network's task that its
/// argument `task` names, template or not, and is served by it alone; every other goal is served by the whole plan.
/// What it hears goes to the part that owns it; the engine itself decides when a cycle runs and a version is sent.
class UtilityEngine final : public engine::SteppedEngine {
 public:
  /// The network is checked already.
  UtilityEngine(const engine::Setup& setup, model::Network network, cycle::Settings settings = {});

  engine::StepOutput step(const engine::StepInputs& inputs) override;
  std::string packed_model() const override;
  /// Replaces a parameter's value by what was measured or found (R116). Returns why not, if it cannot.
  std::string learn(const std::string& parameter, double value);

 private:
  engine::ModelAnswer change(const engine::ModelChange& change, temporal::Time now);
  std::vector<std::string> replace_network(const engine::ModelChange& change, temporal::Time now);
  // measuring.cpp
  void measure();
  void forget_measurements();

  void hear(const engine::StepInputs& inputs);
  void hear_observation(const engine::Observation& observation);
  void hear_product(const engine::DataProduct& product, temporal::Time now);
  void hear_step(const engine::StepStatus& step, temporal::Time now);
  void hear_receipt(const engine::Receipt& receipt, temporal::Time now);
  void await_ends(temporal::Time now);
  void go_on_with(const temporal::FlexiblePlan& executed, temporal::Time now);
  void run_cycle(const engine::StepInputs& inputs, engine::StepOutput& out);
  void send(const engine::StepInputs& inputs, engine::StepOutput& out);

  engine::Setup setup_;
  PlannedNetwork planned_;
  OpenGoals goals_;
  std::map<std::string, temporal::Value> newest_;    // of all timelines, also of those that the network lacks
  std::map<cycle::TaskId, std::uint32_t> attempts_;  // of what runs
  Measurements measurements_;
  std::vector<std::string> doubted_;  // measurements, since the step before
  PublishedPlan published_;
  ToldOutlook outlook_;
  temporal::Time next_cycle_{0};
  bool open_ = false;                         // a plan would be taken
  std::optional<temporal::Time> plan_ended_;  // until it is known how all of it ended
  bool goes_on_ = false;  // it has planned before, so it knows the past better than an executed version does
};

}  // namespace roci::planner::utility_htn::adapter
