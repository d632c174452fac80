// Start waits hold the activities whose start is due and that wait for their preconditions, and until when
// (R68, R98).
#pragma once

#include <optional>
#include <set>
#include <utility>

#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Knows which activities wait for their start, and until when.
class StartWaits {
 public:
  /// The state must outlive this object.
  explicit StartWaits(RunState& state) : state_(&state) {}

  /// Begins the wait of an activity with a stated wait timeout, if its time has come. The timeout counts from
  /// the earliest start on, also while a predecessor that runs is late (R98), but not while a predecessor has
  /// not even begun (that one's own wait bounds this one) or a decision is open.
  void consider(Index activity, temporal::Time now);
  /// Begins a wait for at most `bound`; one that has begun goes on as it is.
  void begin(Index activity, temporal::Time now, temporal::Duration bound);
  /// Goes on with a wait that has begun under the plan before.
  void inherit(Index activity, temporal::Time until);
  /// Returns an activity whose wait is over by now; it is not named again.
  std::optional<Index> take_expired(temporal::Time now);
  /// Returns the end of the wait that ends first.
  std::optional<temporal::Time> next_end();

 private:
  void forget_started();

  RunState* state_;
  std::set<std::pair<temporal::Time, Index>> ends_;  ///< the first one is of an activity that waits, or stale
};

}  // namespace roci::exec::executive
