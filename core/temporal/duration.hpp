// Mission time and durations are integer microseconds, so that windows and orderings are exact.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace roci::temporal {

using Duration = std::chrono::duration<std::int64_t, std::micro>;
using Time = Duration;  ///< since the mission epoch

/// Means "no upper bound". Its negative is "no lower bound"; sums with it saturate (see plus()).
inline constexpr Duration no_bound = Duration::max();

/// Returns whether the duration is neither no_bound nor its negative.
constexpr bool bounded(Duration d) { return d != no_bound && d != -no_bound; }

/// Returns a + b, where an unbounded operand makes the sum unbounded. Only one of them may be unbounded, or
/// both alike.
constexpr Duration plus(Duration a, Duration b) {
  if (!bounded(a)) return a;
  if (!bounded(b)) return b;
  std::int64_t sum = 0;
  if (__builtin_add_overflow(a.count(), b.count(), &sum)) return b.count() > 0 ? no_bound : -no_bound;
  return Duration{sum};
}

/// Returns the duration rounded to microseconds. The value must be finite and fit into 64 bits.
constexpr Duration seconds(double s) {
  return Duration{static_cast<std::int64_t>(s * 1e6 + (s < 0 ? -0.5 : 0.5))};
}
/// Returns the duration in seconds; no_bound is a very large number.
constexpr double to_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-6; }

/// Prints "12.5 s" or "unbounded".
std::string to_text(Duration d);

}  // namespace roci::temporal
