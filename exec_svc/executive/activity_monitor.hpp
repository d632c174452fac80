// The activity monitor watches the conditions and timers of activities under way (R84-R86).
#pragma once

#include "exec_svc/executive/attempts.hpp"
#include "exec_svc/executive/contingency_runs.hpp"
#include "exec_svc/executive/deadlines.hpp"
#include "exec_svc/executive/owner_exchange.hpp"
#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Fails activities whose conditions or time limits are broken, and lets those succeed that have settled.
class ActivityMonitor {
 public:
  /// All arguments must outlive the monitor.
  ActivityMonitor(RunState& state, ContingencyRuns& contingencies, const Deadlines& deadlines,
                  Attempts& attempts, OwnerExchange& exchange)
      : state_(&state),
        contingencies_(&contingencies),
        deadlines_(&deadlines),
        attempts_(&attempts),
        exchange_(&exchange) {}

  /// Returns whether something happened, so that another look is due.
  bool check(temporal::Time now);
  /// From then on the longest duration of an activity that takes longer no longer bounds its end (nor,
  /// through it, the latest times of others): an overrun breaks nothing by itself. Under
  /// LatenessPolicy::deadline it does.
  void note_overruns(temporal::Time now);
  /// Returns when an activity under way is to be looked at next, or no_bound.
  temporal::Time next_timer(Index activity, temporal::Time now) const;

 private:
  bool check_activity(Index activity, temporal::Time now);
  bool check_contingency(Index activity, temporal::Time now);
  bool check_command(Index activity, temporal::Time now);
  bool check_maintenance(Index activity, temporal::Time now);
  bool try_finish(Index activity, temporal::Time now);

  RunState* state_;
  ContingencyRuns* contingencies_;
  const Deadlines* deadlines_;
  Attempts* attempts_;
  OwnerExchange* exchange_;
};

}  // namespace roci::exec::executive
