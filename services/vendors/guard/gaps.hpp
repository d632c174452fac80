// A GAP tells a reader that a writer has no samples of some sequence numbers, and a HEARTBEAT that it has none before
// the first. Fast DDS walks through them one by one, with the reader locked (docs/dds.md, "Reports to upstream"); this
// file bounds what it walks through and keeps.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "services/vendors/guard/identities.hpp"
#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {

/// Says where the samples of a writer begin.
struct WriterStart {
  std::uint32_t writer = 0;  ///< its entity id
  std::int64_t first = 1;
};

/// Counts the sequence numbers that GAPs and HEARTBEATs skip. Those of a GAP that begins at number 1, as a late joiner
/// is sent by a writer with a long past, cost time alone. Others may stand beyond what the reader has; it keeps each of
/// these, some 40 bytes.
struct SkippedNumbers {
  /// Bounds what one datagram, and one socket at a time, may skip.
  static constexpr std::int64_t kMostFromStart = std::int64_t{1} << 28;
  static constexpr std::int64_t kMostFurtherUp = std::int64_t{1} << 18;
  /// A walk to a number up to this one takes some milliseconds, and is not counted.
  static constexpr std::int64_t kFreeStart = std::int64_t{1} << 16;

  std::int64_t from_start = 0;
  std::int64_t further_up = 0;
  std::vector<WriterStart> starts{};  ///< of HEARTBEATs, those beyond kFreeStart

  bool none() const { return from_start == 0 && further_up == 0 && starts.empty(); }
  /// A datagram with more is refused. A writer is asked again for what it has not said, and then says less at a time.
  bool fits_one_datagram() const { return from_start <= kMostFromStart && further_up <= kMostFurtherUp; }
  SkippedNumbers& operator+=(const SkippedNumbers&);
};

/// Returns what a submessage skips: nothing if it is no GAP or HEARTBEAT. It must have passed examine_submessage().
SkippedNumbers skipped_by(const Submessage&);

/// Bounds what each socket may skip in the course of time: kBurst at once, and so much again as the rates give back.
/// What an honest writer says too early it says again, since the reader goes on to ask.
class GapBudget {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr SkippedNumbers kBurst{SkippedNumbers::kMostFromStart, 4 * SkippedNumbers::kMostFurtherUp};
  static constexpr SkippedNumbers kPerSecond{kBurst.from_start / 8, kBurst.further_up / 16};

  /// Each number before the first of a HEARTBEAT costs a reader as much as four at the start of a GAP (130 ns and
  /// 30 ns, AMD EPYC). So a writer is believed a past of 2^26 samples at once.
  static constexpr std::int64_t kCostOfStart = 4;
  /// Bound the writers of one socket, and the sockets, whose starts are remembered. Of sockets the longest silent one
  /// is forgotten; of one socket all are, so that those of participants which are gone leave, and who still speaks pays
  /// once more.
  static constexpr std::size_t kStarts = 256, kSockets = 1024;

  /// Takes these numbers, which a participant has said, from the budget of its socket, or returns false and takes none.
  /// A HEARTBEAT that is repeated costs nothing: a reader walks to each number once.
  bool take(const Source&, const GuidPrefix&, const SkippedNumbers&, Time now);

 private:
  struct Spent {
    double from_start = 0;
    double further_up = 0;
    Time at;
    Spent by(Time now) const;
  };

  struct Starts {
    std::map<std::pair<GuidPrefix, std::uint32_t>, std::int64_t> firsts;  // by writer: up to where readers have walked
    Time heard;
  };

  void remember(const Source&, const GuidPrefix&, const SkippedNumbers&, Time now);

  std::map<Source, Spent> spent_;  // of sockets that have not got everything back yet
  std::map<Source, Starts> starts_;
};

}  // namespace roci::services::vendors::guard
