// The pace ties simulated time to wall time.
#pragma once

#include "core/temporal/duration.hpp"
#include "services/clock/wall.hpp"

namespace roci::services::clock {

/// Keeps simulated time at most `rate` times as fast as wall time.
class Pace {
 public:
  /// `rate` is in simulated seconds per wall second; 0 means no limit.
  Pace(double rate, WallTime start) : rate_(rate), reached_at_(start) {}

  /// Returns when `time` may be reached at the earliest.
  WallTime earliest(temporal::Time time) const;
  /// Returns the mission time that fits `now`.
  temporal::Time time_at(WallTime now) const;
  void reached(temporal::Time time, WallTime now);

 private:
  double rate_;
  temporal::Time time_{0};
  WallTime reached_at_;
};

}  // namespace roci::services::clock
