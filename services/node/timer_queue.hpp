// The timer queue has the timers of one node.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/temporal/duration.hpp"

namespace roci::services::node {

/// Fires timers in the order (time, creation).
class TimerQueue {
 public:
  using Id = std::uint64_t;

  Id add(temporal::Time due, std::function<void()> fire);
  void cancel(Id);
  std::optional<temporal::Time> earliest() const;

  /// Fires what is due at `now`. Timers that are added meanwhile wait for the next call, even if they are
  /// due.
  void run_due(temporal::Time now);

 private:
  std::map<std::pair<temporal::Time, Id>, std::function<void()>> timers_;
  std::unordered_map<Id, temporal::Time> due_;
  Id next_ = 1;
};

}  // namespace roci::services::node
