// Times to come of things whose time may still change.
#pragma once

#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/stn.hpp"

namespace roci::exec {

/// A changed time is entered again; entries that no longer hold are dropped when they come up. Ties by point.
class Agenda {
 public:
  using Entry = std::pair<temporal::Time, temporal::TimePoint>;

  void enter(temporal::Time at, temporal::TimePoint point) { entries_.emplace(at, point); }

  /// The first entry that holds(time, point).
  template <typename Holds>
  std::optional<Entry> first(Holds holds) {
    while (!entries_.empty() && !holds(entries_.top().first, entries_.top().second)) entries_.pop();
    return entries_.empty() ? std::nullopt : std::optional(entries_.top());
  }

  void pop() { entries_.pop(); }

 private:
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> entries_;
};

}  // namespace roci::exec
