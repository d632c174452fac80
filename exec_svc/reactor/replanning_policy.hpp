// A replanning policy decides when a plan is asked for and what goes on meanwhile.
#pragma once

#include <memory>

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/plan_recovery.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/planning_cycle.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

/// Refers to the parts of the reactor that a policy works with; the reactor owns them.
struct PolicyParts {
  MissionState& state;
  RunningPlan& plan;
  PlannerCall& call;
  Safing& safing;
  PlanningCycle& planning;
  PlanRecovery& recovery;
};

/// Serves one value of mission::Replanning.
class ReplanningPolicy {
 public:
  virtual ~ReplanningPolicy() = default;

  /// Decides whether a plan is asked for, taken or given up, once the inputs have been taken in and the
  /// executive has acted on them.
  virtual void step(temporal::Time now, const ReactorInputs& inputs) = 0;
  /// Asks again, after a restart, for what was on its way to the planner.
  virtual void resume(temporal::Time now) = 0;
  /// Returns what the engine was told of its plan, or null where plans are asked for.
  virtual const PlanReceipt* receipt() const { return nullptr; }

  virtual void save(archive::Writer& archive) const = 0;
  virtual void restore(archive::Reader& archive) = 0;
};

std::unique_ptr<ReplanningPolicy> make_replanning_policy(mission::Replanning kind, const PolicyParts& parts);

}  // namespace roci::exec::reactor
