// Mission time from the system clock: microseconds since the run's epoch, times a scale.
#pragma once

#include <cstdint>

#include "services/clock/wall.hpp"
#include "services/time.hpp"

namespace roci::services {

class LiveClock {
 public:
  LiveClock(std::int64_t epoch_unix_us, double scale) : epoch_unix_us_(epoch_unix_us), scale_(scale) {}

  Time now() const;
  wall::Clock::duration wall_for(Duration mission) const;

 private:
  std::int64_t epoch_unix_us_;
  double scale_;
};

}  // namespace roci::services
