// Timelines count in whole numbers, so that the order of sums never matters, an undo is exact,
// and 0.1 + 0.2 does not exceed 0.3.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/temporal/duration.hpp"

namespace roci::temporal::timelines {

/// Counts 1e-15 of a timeline's unit. A rate counts 1e-15 per microsecond, that is 1e-9 per second. Sums of 1,000 of
/// the greatest amounts and rates over all of time fit.
__extension__ typedef __int128 Exact;

inline constexpr Exact kUnit = 1'000'000'000'000'000;
/// Exceeds every sum, and stands for a missing bound.
inline constexpr Exact kBeyond = kUnit * kUnit * 100'000'000;

inline constexpr double kMostAmount = 1e15;                             ///< of an impact, a bound or a value
inline constexpr double kMostRate = 1e9;                                ///< per second
inline constexpr Time kLastTime{std::int64_t{10'000'000'000'000'000}};  ///< 317 years

/// Returns the number in billionths. Above a million it is taken as a decimal of six digits after the point, above 1e9
/// of three, above 1e12 of none, since a double holds no more: so what was written as a decimal counts as that decimal.
inline Exact billionths(double number) {
  const double size = std::abs(number);
  if (size < 1e6) return static_cast<Exact>(std::round(number * 1e9));
  if (size < 1e9) return static_cast<Exact>(std::round(number * 1e6)) * 1'000;
  if (size < 1e12) return static_cast<Exact>(std::round(number * 1e3)) * 1'000'000;
  return static_cast<Exact>(std::round(number)) * 1'000'000'000;
}

/// Returns an amount or a bound; what is greater than kMostAmount is beyond every sum.
inline Exact exact_amount(double amount) {
  if (amount > kMostAmount) return kBeyond;
  if (amount < -kMostAmount) return -kBeyond;
  return billionths(amount) * 1'000'000;
}
/// Returns a rate per second as one per microsecond.
inline Exact exact_rate(double per_second) { return billionths(per_second); }

/// Returns the nearest double.
inline double to_number(Exact amount) { return static_cast<double>(amount) / static_cast<double>(kUnit); }

}  // namespace roci::temporal::timelines
