// An agenda holds times to come of things whose time may still change.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/stn.hpp"

namespace roci::exec::executive {

/// Holds entries in order of time, then of point. A changed time is entered again; entries that no longer
/// hold are dropped when they come up, or all at once when they would be the most.
class Agenda {
 public:
  using Entry = std::pair<temporal::Time, temporal::TimePoint>;

  void enter(temporal::Time at, temporal::TimePoint point) {
    entries_.emplace_back(at, point);
    std::push_heap(entries_.begin(), entries_.end(), std::greater<>{});
  }

  /// Returns the first entry for which holds(time, point) is true, and drops those before it.
  template <typename Holds>
  std::optional<Entry> first(Holds holds) {
    const auto stale = [&](const Entry& entry) { return !holds(entry.first, entry.second); };
    if (entries_.size() > prune_at_) {
      std::erase_if(entries_, stale);
      std::make_heap(entries_.begin(), entries_.end(), std::greater<>{});
      prune_at_ = 2 * entries_.size() + smallest_prune;
    }
    while (!entries_.empty() && stale(entries_.front())) pop();
    return entries_.empty() ? std::nullopt : std::optional(entries_.front());
  }

  void pop() {
    std::pop_heap(entries_.begin(), entries_.end(), std::greater<>{});
    entries_.pop_back();
  }

 private:
  static constexpr std::size_t smallest_prune = 64;
  std::size_t prune_at_ = smallest_prune;
  std::vector<Entry> entries_;
};

}  // namespace roci::exec::executive
