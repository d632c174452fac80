// Wall time. Nothing else asks the system for the time; everything else is told.
#pragma once

#include <chrono>
#include <cstdint>

namespace roci::services::clock {

/// Names the monotonic clock, which neither jumps nor stands still, and has no date.
using WallClock = std::chrono::steady_clock;
using WallTime = WallClock::time_point;
using WallDuration = WallClock::duration;

inline WallTime wall_now() { return WallClock::now(); }

/// Reads the system clock: microseconds since 1970.
std::int64_t unix_us();

inline WallDuration wall_seconds(double s) {
  return std::chrono::duration_cast<WallDuration>(std::chrono::duration<double>(s));
}

}  // namespace roci::services::clock
