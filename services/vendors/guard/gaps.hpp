// A GAP tells a reader that a writer has no samples of some sequence numbers. Fast DDS walks through them one by one,
// with the reader locked (docs/dds.md, "Reports to upstream"); this file bounds what it walks through and keeps.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>

#include "services/vendors/guard/identities.hpp"
#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {

/// Counts the sequence numbers that GAPs skip. Those of a GAP that begins at number 1, as a late joiner is sent by a
/// writer with a long past, cost time alone, 3 ns each. Others may stand beyond what the reader has; it keeps each of
/// these, some 40 bytes.
struct SkippedNumbers {
  /// Bounds what one datagram, and one socket at a time, may skip.
  static constexpr std::int64_t kMostFromStart = std::int64_t{1} << 28;
  static constexpr std::int64_t kMostFurtherUp = std::int64_t{1} << 18;

  std::int64_t from_start = 0;
  std::int64_t further_up = 0;

  bool none() const { return from_start == 0 && further_up == 0; }
  /// A datagram with more is refused. A writer is asked again for what it has not said, and then says less at a time.
  bool fits_one_datagram() const { return from_start <= kMostFromStart && further_up <= kMostFurtherUp; }
  SkippedNumbers& operator+=(const SkippedNumbers&);
};

/// Returns what a submessage skips: nothing if it is no GAP. Its numbers must be positive (RTPS 2.3, 8.3.7.4).
SkippedNumbers skipped_by(const Submessage&);

/// Bounds what each socket may skip in the course of time: kBurst at once, and so much again as the rates give back.
/// What an honest writer says too early it says again, since the reader goes on to ask.
class GapBudget {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr SkippedNumbers kBurst{SkippedNumbers::kMostFromStart, 4 * SkippedNumbers::kMostFurtherUp};
  static constexpr SkippedNumbers kPerSecond{kBurst.from_start / 8, kBurst.further_up / 16};

  /// Takes these numbers from the budget of a socket, or returns false and takes none.
  bool take(const Source&, const SkippedNumbers&, Time now);

 private:
  struct Spent {
    double from_start = 0;
    double further_up = 0;
    Time at;
    Spent by(Time now) const;
  };

  std::map<Source, Spent> spent_;  // of sockets that have not got everything back yet
};

}  // namespace roci::services::vendors::guard
