// The stepped host steps an engine that plans all the time, and sends the versions of its plan.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner_svc/engine/table.hpp"
#include "planner_svc/engine/version_exchange.hpp"
#include "planner_svc/network_orders_service.hpp"
#include "planner_svc/settings.hpp"
#include "planner_svc/step_records.hpp"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/outlook.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"
#include "services/bounds/tally.hpp"
#include "services/publisher.hpp"
#include "services/worker.hpp"

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
  using Key = std::pair<std::string, std::string>;                        // issuer, id
  using ResultKey = std::tuple<std::string, std::string, std::uint32_t>;  // commander, activity, attempt
  struct HeardGoal {
    std::optional<engine::Goal> goal;
    std::optional<engine::GoalState> state;  // as the executive says
    bool told = false;                       // to the engine, as open
  };
  struct StepResult {
    engine::StepOutput output;
    std::string error;  // what the engine threw
  };

  void subscribe_all();
  /// Returns whether a table has room for this name, or knows it already.
  template <class Table>
  bool has_room(const Table& table, const typename Table::key_type& name, std::size_t room, const char* what);
  bool is_ours(const v1::SampleHeader& header) const;
  void hear_goal(const v1::Goal& goal);
  void hear_status(const v1::GoalStatus& status);
  void note_goal(const Key& key, HeardGoal& heard, bool changed);
  void hear_plan(const v1::Plan& plan);
  void note_executive(const std::string& executive);
  void hear_result(const v1::CommandAck& ack);
  void hear_receipt(const engine::Receipt& receipt);
  void note_executed();
  void tell_again(engine::StepInputs& inputs) const;
  void forget_steps_of_others(const temporal::FlexiblePlan& plan);
  void step_soon();
  void begin_step();
  void end_step(temporal::Time now, StepResult result);
  void send(temporal::Time now, const temporal::PlanDelta& delta);
  std::string refusal_of(temporal::Time now, const temporal::PlanDelta& delta,
                         temporal::FlexiblePlan& next) const;
  std::shared_ptr<engine::SteppedEngine> make_engine();
  void make_anew();
  void begin_record();
  void record(const engine::StepOutcome& outcome);
  void tell_account(const engine::StepOutput& output);
  void tell_outlook(temporal::Time now, const engine::StepOutput& output);
  void tell_blocking(std::vector<engine::BlockingGoal> blocking);
  void report(v1::Severity severity, const std::string& code, const std::string& text);

  services::Node& node_;
  const engine::TableEntry& entry_;
  NetworkOrders orders_;
  engine::Setup setup_;
  std::shared_ptr<engine::SteppedEngine> engine_;
  StepRecords records_;
  std::unique_ptr<engine::Checker> checker_;
  services::Publisher<v1::PlanDelta> deltas_;
  services::Publisher<v1::DownlinkSchedule> schedules_;
  services::Publisher<v1::MissionOutlook> outlooks_;
  services::Publisher<v1::Event> events_;

  engine::StepInputs heard_;                             // since the step before
  std::string executive_;                                // whose plan it is; empty: not known yet
  std::map<Key, HeardGoal> goals_;                       // all of this run
  engine::Timelines state_;                              // newest observations
  std::map<std::string, engine::DataProduct> products_;  // by id
  temporal::Progress progress_;                          // of the executed version
  std::map<ResultKey, engine::CommandResult> results_;   // likewise, of completed commands
  engine::VersionExchange versions_;
  std::vector<engine::BlockingGoal> blocking_;  // as told

  services::bounds::Tally refusals_;
  bool due_ = false;       // a step comes in this turn
  bool stepping_ = false;  // one is under way
  std::optional<services::Node::TimerId> wake_;
  services::Worker worker_;
};

}  // namespace roci::planner
