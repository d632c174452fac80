// Dispatch lets points happen that may happen now: starts, ends without command, free points. It says why a
// start that is due may not happen, and breaks the plan when it never can (R47-R50).
#pragma once

#include "exec_svc/executive/attempts.hpp"
#include "exec_svc/executive/run_state.hpp"
#include "exec_svc/executive/start_waits.hpp"

namespace roci::exec::executive {

/// Starts what is due and may start, and owns nothing but whether starts are held.
class Dispatch {
 public:
  /// All arguments must outlive this object.
  Dispatch(RunState& state, StartWaits& waits, Attempts& attempts)
      : state_(&state), waits_(&waits), attempts_(&attempts) {}

  /// Returns whether something happened, so that another look is due.
  bool let_happen(temporal::Time now);
  /// Skips, or fails, what could not start within its wait. Returns whether something was.
  bool expire_waits(temporal::Time now);
  /// Breaks the plan if the latest time of a start has passed (R49).
  void break_if_late(temporal::Time now);
  /// Holds or releases all starts. While held, nothing starts; latest starts still pass.
  void hold_starts(bool hold) { starts_held_ = hold; }

 private:
  bool attempt(temporal::TimePoint point, temporal::Time now);
  bool try_start(Index activity, temporal::Time now);
  bool try_internal_end(Index activity, temporal::Time now);
  std::string refusal(Index activity) const;
  std::string unmet_preconditions(Index activity) const;

  RunState* state_;
  StartWaits* waits_;
  Attempts* attempts_;
  bool starts_held_ = false;
};

}  // namespace roci::exec::executive
