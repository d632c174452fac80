// The only place that asks the system for the time. Everything else is told.
#pragma once

#include <chrono>
#include <cstdint>

namespace roci::services::wall {

using Clock = std::chrono::steady_clock;
using Instant = Clock::time_point;

inline Instant now() { return Clock::now(); }
std::int64_t unix_us();  // system clock, microseconds since 1970

inline Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

}  // namespace roci::services::wall
