// How long the simulated clock stands still after a death, so that mission time does not run on without a
// service that is about to return, or that another process is about to stand in for. Pure.
#pragma once

#include <string_view>

#include "services/clock/wall.hpp"

namespace roci::services::clock {

class RestartHold {
 public:
  explicit RestartHold(WallDuration length) : length_(length) {}

  /// `cause` is that of PeerChange. Somebody is about to start a killed one again, or has and it is about to
  /// say that it is ready; one that left or hangs will not be back soon.
  void lost(std::string_view cause, WallTime now) {
    if (cause == "killed" || cause == "restarted") until_ = now + length_;
  }

  /// `complete` says that every service of the roster is there, so that nobody is waited for.
  bool holds(bool complete, WallTime now) const { return !complete && now < until_; }

 private:
  WallDuration length_;
  WallTime until_;
};

}  // namespace roci::services::clock
