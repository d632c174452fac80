// When a link is open: its windows without its cuts.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::services::link {

/// Lasts from the first time on, and ends before the second.
using Interval = std::pair<temporal::Time, temporal::Time>;

class Schedule {
 public:
  /// Always open.
  Schedule();
  /// Open in the windows, but for the cuts. Both are in order and do not overlap; no windows: always.
  Schedule(std::vector<Interval> windows, const std::vector<Interval>& cuts);

  bool open(temporal::Time) const;
  /// The first time from `from` on at which it is open; empty if it never is again.
  std::optional<temporal::Time> next_open(temporal::Time from) const;
  /// The end of the interval that holds `time`; `time` itself where it is not open.
  temporal::Time closes(temporal::Time) const;

 private:
  std::vector<Interval> intervals_;  // in order, apart
};

}  // namespace roci::services::link
