/// What follows when the running plan ends, breaks or will break: the way on is what the recovery policy
/// still has, a new plan, else the ground, else nothing (R102).
#pragma once

#include <string>

#include "exec_svc/reactor/failure_backoff.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

class PlanRecovery {
 public:
  /// All outlive this.
  PlanRecovery(MissionState& state, RunningPlan& plan, PlannerCall& call, Safing& safing);

  /// A component whose command succeeded is trusted again. Looks at the steps that this reactor step put out.
  void note_successes();

  /// Looks after a plan that a planner call brought: its end, its break, and conflicts of activities that are
  /// not due yet. `next_is_coming`: its end alone asks for no other plan.
  void monitor(temporal::Time now, bool next_is_coming);

  /// The running plan must not go on.
  void break_plan(temporal::Time now, const std::string& reason);

  /// Counts a wish for a plan as granted. False: there were too many, and the robot is safe.
  bool may_replan(temporal::Time now);

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    FailureBackoff::fields(archive, self.backoff_);
    FailureBackoff::fields(archive, self.breaks_);
    archive(self.last_break_);
  }

 private:
  void handle_failure(temporal::Time now, const executive::Outcome& outcome);
  /// `kind` of break of an activity, which is no failure of its command: one like the break before, with nothing done
  /// since, waits before the next plan as a component that fails again does (FailureBackoff);
  /// in the end its goals are given up.
  void count_break(temporal::Time now, const std::string& activity, const std::string& kind);
  void count_failure(temporal::Time now, const executive::Outcome& outcome);
  /// Says so on the timeline `trust.SUBSYSTEM`: what a plan may do for other goals without this one is up to its model.
  void note_trust(const std::string& subsystem, bool lost);

  MissionState* state_;
  RunningPlan* plan_;
  PlannerCall* call_;
  Safing* safing_;
  RecoveryPolicy policy_;
  FailureBackoff backoff_;  ///< of components whose commands fail again and again
  FailureBackoff breaks_;   ///< of plans that break at the same place again and again
  std::string last_break_;  ///< its place and kind; empty: something was done since
};

}  // namespace roci::exec::reactor
