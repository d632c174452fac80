// The schedule of a link says when it is open: in its windows, without its cuts.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::services::link {

/// Holds an interval that begins at the first time and ends before the second.
using Interval = std::pair<temporal::Time, temporal::Time>;

/// Answers when a link is open.
class Schedule {
 public:
  /// Makes a schedule that is always open.
  Schedule();
  /// Makes a schedule that is open in the windows (always, if there are none) but for the cuts. Both are in
  /// order and do not overlap.
  Schedule(std::vector<Interval> windows, const std::vector<Interval>& cuts);

  bool open(temporal::Time) const;
  /// Returns the first time from `from` on at which it is open, or nothing if it never is again.
  std::optional<temporal::Time> next_open(temporal::Time from) const;
  /// Returns the end of the open interval that holds the time, or the time itself where it is not open.
  temporal::Time closes(temporal::Time) const;

 private:
  std::vector<Interval> intervals_;  // in order, apart
};

}  // namespace roci::services::link
