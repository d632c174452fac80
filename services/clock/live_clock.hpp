// Mission time from the system clock: microseconds since the run's epoch, times a scale.
#pragma once

#include <cstdint>

#include "core/temporal/duration.hpp"
#include "services/clock/wall.hpp"

namespace roci::services::clock {

class LiveClock {
 public:
  LiveClock(std::int64_t epoch_unix_us, double scale) : epoch_unix_us_(epoch_unix_us), scale_(scale) {}

  temporal::Time now() const;
  WallDuration wall_for(temporal::Duration mission) const;

 private:
  std::int64_t epoch_unix_us_;
  double scale_;
};

}  // namespace roci::services::clock
