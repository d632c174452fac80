// Windows are timelines that are true in given intervals, such as a relay above the horizon.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Describes a Boolean timeline that is true in [opens, closes) of each interval. Intervals ascend and do not
/// overlap.
struct Window {
  std::string timeline;
  std::vector<std::pair<temporal::Time, temporal::Time>> open;

  bool is_open(temporal::Time) const;
  /// Returns the first opening or closing after `t`, or nothing.
  std::optional<temporal::Time> next_change(temporal::Time t) const;
  /// Shuts it in [from, until).
  void shut(temporal::Time from, temporal::Time until);
};

}  // namespace roci::sim::world
