// The stepped host steps an engine that plans all the time, and sends the versions of its plan.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "planner_svc/engine/table.hpp"
#include "planner_svc/engine/version_exchange.hpp"
#include "planner_svc/engine_inputs.hpp"
#include "planner_svc/network_orders_service.hpp"
#include "planner_svc/settings.hpp"
#include "planner_svc/step_loop_service.hpp"
#include "planner_svc/step_publisher_service.hpp"
#include "planner_svc/step_records.hpp"
#include "roci_idl/command.h"
#include "roci_idl/goal.h"
#include "roci_idl/planner.h"

namespace roci::planner {

/// Steps the engine once for all that is heard within one turn of the loop. Under the simulated clock steps
/// have their place in mission time and take none of it. A version that the engine's checker refuses is
/// reported (event "planner.defect") and never sent.
class SteppedHost {
 public:
  /// Hosts the engine that `entry` makes, which plans all the time; throws what that throws. All arguments
  /// must outlive this object. `networks` is the folder that keeps what the ground changes of the engine's
  /// model; if it is empty, no change is taken. `steps` is the folder that keeps the engine's steps; if it is
  /// empty, none are kept.
  SteppedHost(services::Node& node, const Settings& settings, const engine::TableEntry& entry,
              const std::filesystem::path& networks, const std::filesystem::path& steps);
  SteppedHost(const SteppedHost&) = delete;
  SteppedHost& operator=(const SteppedHost&) = delete;

 private:
  void subscribe_all();
  bool is_ours(const v1::SampleHeader& header) const;
  void hear(const v1::Goal& goal);
  void hear(const v1::GoalStatus& status);
  void hear(const v1::Plan& plan);
  void hear(const v1::PlanReceipt& receipt);
  void hear(const v1::StepStatus& step);
  void hear(const v1::CommandAck& ack);
  void hear(const v1::DataProduct& product);
  void hear(const v1::Observation& observation);
  bool is_possible(const engine::Observation& observation);
  temporal::Time happened(temporal::Time said, const std::string& what);
  void note_executed();
  void step_if(bool news);
  void begin_step();
  void end_step(temporal::Time begun, StepLoop::Result result);
  void take(temporal::Time begun, engine::StepOutput output);
  void send(temporal::Time begun, const temporal::PlanDelta& delta);
  std::string refusal_of(temporal::Time begun, const temporal::PlanDelta& delta,
                         temporal::FlexiblePlan& next) const;
  std::shared_ptr<engine::SteppedEngine> make_engine();
  void make_anew();
  void begin_record();
  void record(const engine::StepOutcome& outcome);

  services::Node& node_;
  const engine::TableEntry& entry_;
  NetworkOrders orders_;
  engine::Setup setup_;
  std::shared_ptr<engine::SteppedEngine> engine_;  // the step under way shares it
  std::unique_ptr<engine::Checker> checker_;
  StepRecords records_;
  EngineInputs inputs_;
  engine::VersionExchange versions_;
  StepPublisher publisher_;
  StepLoop loop_;
};

}  // namespace roci::planner
