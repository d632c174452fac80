#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_svc/values.hpp"

namespace roci::sim {

/// A Boolean timeline that is true in [opens, closes) of each interval. Intervals ascend and do not overlap.
struct Window {
  std::string timeline;
  std::vector<std::pair<Time, Time>> open;

  bool is_open(Time) const;
  /// First opening or closing after `t`.
  std::optional<Time> next_change(Time t) const;
};

}  // namespace roci::sim
