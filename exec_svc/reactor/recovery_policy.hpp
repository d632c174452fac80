// A recovery policy says what a strategy of recovery may do (R102). One plan generator serves all strategies.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::reactor {

/// Says what may be done about a failure: push, retry and contingency by the executive; replanning, dropping
/// goals and asking the ground by the reactor.
struct RecoveryPolicy {
  bool flexible = true;  ///< push, retry, contingency
  bool replans = true;   ///< from observations; goals are dropped where not all fit
  bool asks_ground = true;
};

RecoveryPolicy recovery_policy_of(mission::RecoveryStrategy strategy);

/// Takes the executive's recovery actions out of a plan.
void make_inflexible(temporal::FlexiblePlan& plan);

/// Returns the bounds, contingencies and start policy of the mission.
executive::ExecutiveSettings executive_settings(const mission::MissionModel& mission);

}  // namespace roci::exec::reactor
