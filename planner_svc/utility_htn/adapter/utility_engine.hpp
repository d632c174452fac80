// This is the utility-driven engine as planner_svc steps it (R66, R77–R81): it hears observations, goals and what
// became of tasks, runs its cycle at the process interval, and sends versions of its plan.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/measurements.hpp"
#include "planner_svc/utility_htn/adapter/outlook.hpp"
#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "planner_svc/utility_htn/adapter/versions.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::adapter {

/// Plans the network that is the mission's model. A goal of kind `request` asks for the network's task that its
/// argument `task` names, template or not, and is served by it alone; every other goal is served by the whole plan.
class UtilityEngine final : public engine::SteppedEngine {
 public:
  /// The network is checked already.
  UtilityEngine(const engine::Setup& setup, model::Network network, cycle::Settings settings = {});
  ~UtilityEngine() override;

  engine::StepOutput step(const engine::StepInputs& inputs) override;
  std::string packed_model() const override;
  /// Replaces a parameter's value by what was measured or found (R116). Returns why not, if it cannot.
  std::string learn(const std::string& parameter, double value);

 private:
  // model_change.cpp
  engine::ModelAnswer change(const engine::ModelChange& change, temporal::Time now);
  std::vector<std::string> replace_network(const engine::ModelChange& change, temporal::Time now);
  std::vector<std::string> in_the_way_of(const model::Network& next, const flattening::Chains& chains) const;
  void go_on_with(model::Network next, temporal::Time now);
  // measuring.cpp
  void measure();
  void forget_measurements();

  void hear(const engine::StepInputs& inputs);
  void hear_goal(const engine::Goal& goal);
  void hear_end(const engine::EndedGoal& ended);
  void hear_observation(const engine::Observation& observation);
  bool tasks_move(const std::string& timeline) const;
  void hear_product(const engine::DataProduct& product, temporal::Time now);
  void hear_step(const engine::StepStatus& step, temporal::Time now);
  void hear_receipt(const engine::Receipt& receipt, temporal::Time now);
  void begin_fixed(temporal::Time origin);
  void await_ends(temporal::Time now);
  void go_on_with(const temporal::FlexiblePlan& executed, temporal::Time now);
  void send(const engine::StepInputs& inputs, engine::StepOutput& out);
  void tell_outlook(const cycle::Report& report, const std::vector<cycle::Block>& begun_before,
                    temporal::Time now, engine::StepOutput& out);
  void serve_requests(temporal::FlexiblePlan& plan) const;
  std::vector<std::string> served_goals() const;
  std::optional<model::TaskIndex> requested_by(const engine::Goal& goal) const;

  engine::Setup setup_;
  model::Network network_;
  flattening::Chains chains_;
  std::unique_ptr<assessor::Assessor> assessor_;
  std::unique_ptr<search::Scheduler> scheduler_;
  cycle::Settings settings_;
  delivery::Delivery delivery_;
  std::unique_ptr<cycle::Cycle> cycle_;  // from the first step on
  std::vector<engine::Goal> goals_;      // open
  std::vector<engine::BlockingGoal> blocking_;
  std::map<cycle::TaskId, std::uint32_t> attempts_;  // of what runs
  std::map<std::string, temporal::Value>
      newest_;  // of all timelines, also those that the network does not have
  std::vector<std::string> doubted_;
  std::set<std::string> unannounced_;  // internal timelines of which the executive does not know yet
  bool to_tell_ = false;               // the next cycle sends a version, whatever it does
  Measurements measurements_;
  Points points_;
  Versions versions_;
  std::uint32_t refused_in_turn_ = 0;  // versions; a refused one is sent again, after a while
  temporal::Time again_at_{0};
  std::optional<temporal::Time> plan_ended_;  // until it is known how all of it ended
  bool goes_on_ = false;  // it has planned before, so it knows the past better than an executed version does
  bool has_begun_ = false;                         // fixed tasks stand as the first cycle can place them
  std::optional<temporal::PlanActivity> initial_;  // until it is over
  Outlooks outlooks_;
  engine::DownlinkSchedule told_schedule_;
  engine::MissionOutlook told_outlook_;
  bool to_look_ = true;  // something was heard that an outlook tells
  temporal::Time origin_{0};
  temporal::Time next_cycle_{0};
  bool open_ = false;
};

}  // namespace roci::planner::utility_htn::adapter
