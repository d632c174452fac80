// The restart hold keeps the simulated clock still after a death, so that mission time does not run on
// without a service that is about to return, or that another process is about to stand in for. It is pure.
#pragma once

#include <string_view>

#include "services/clock/wall.hpp"

namespace roci::services::clock {

/// Says whether the clock stands still for a service that is about to be replaced, for `length` of wall time
/// at most.
class RestartHold {
 public:
  explicit RestartHold(WallDuration length) : length_(length) {}

  /// Begins a hold for a `cause` (that of PeerChange) after which the service will be back soon: it was
  /// killed, or was restarted and is about to be ready. One that left or hangs begins none.
  void lost(std::string_view cause, WallTime now) {
    if (cause == "killed" || cause == "restarted") until_ = now + length_;
  }

  /// Returns whether the clock stands still. `complete` says that every service of the roster is there, so
  /// that none is waited for.
  bool holds(bool complete, WallTime now) const { return !complete && now < until_; }

 private:
  WallDuration length_;
  WallTime until_;
};

}  // namespace roci::services::clock
