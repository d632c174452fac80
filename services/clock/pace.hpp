// Keeps simulated time at most `rate` times as fast as wall time.
#pragma once

#include "services/clock/wall.hpp"
#include "services/time.hpp"

namespace roci::services {

class Pace {
 public:
  // rate: simulated seconds per wall second; 0: no limit.
  Pace(double rate, wall::Instant start) : rate_(rate), reached_at_(start) {}

  // When `time` may be reached at the earliest.
  wall::Instant earliest(Time time) const;
  // The mission time that fits `now`.
  Time time_at(wall::Instant now) const;
  void reached(Time time, wall::Instant now);

 private:
  double rate_;
  Time time_{0};
  wall::Instant reached_at_;
};

}  // namespace roci::services
