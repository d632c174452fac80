// Plan recovery decides what follows when the running plan ends, breaks or will break: what the recovery
// policy still has, a new plan, else the ground, else nothing (R102).
#pragma once

#include <string>

#include "exec_svc/reactor/failure_backoff.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/recovery_policy.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

/// Watches the running plan, and chooses how to go on after a failure, an end or a conflict seen ahead.
class PlanRecovery {
 public:
  /// All arguments must outlive this object.
  PlanRecovery(MissionState& state, RunningPlan& plan, PlannerCall& call, Safing& safing);

  /// Restores trust in each component whose command succeeded, by the steps that this reactor step put out.
  void note_successes();

  /// Monitors a plan that a planner call brought: its end, its break, and conflicts of activities that are
  /// not due yet. With `next_is_coming`, its end alone asks for no other plan.
  void monitor(temporal::Time now, bool next_is_coming);

  /// Gives the running plan up, and does what the recovery policy asks for then: a new plan, the ground, or
  /// nothing.
  void break_plan(temporal::Time now, const std::string& reason);

  /// Counts a wish for a plan as granted. Returns false if there were too many, and the robot is made safe.
  bool may_replan(temporal::Time now);

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    FailureBackoff::fields(archive, self.backoff_);
    FailureBackoff::fields(archive, self.breaks_);
    archive(self.last_break_);
  }

 private:
  void handle_failure(temporal::Time now, const executive::Outcome& outcome);
  /// Counts a `kind` of break of an activity that is no failure of its command. A repeated break, with nothing done
  /// since, waits before the next plan as a component that fails again does (FailureBackoff); in the end its goals
  /// are given up.
  void count_break(temporal::Time now, const std::string& activity, const std::string& kind);
  void count_failure(temporal::Time now, const executive::Outcome& outcome);
  /// Publishes on the timeline `trust.SUBSYSTEM` whether the subsystem is trusted; the planning model decides what a
  /// plan may still do without it.
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
