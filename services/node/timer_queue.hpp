// Timers of one node, in the order (time, creation).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "services/time.hpp"

namespace roci::services {

class TimerQueue {
 public:
  using Id = std::uint64_t;

  Id add(Time due, std::function<void()> fire);
  void cancel(Id);
  std::optional<Time> earliest() const;

  // Fires what is due at `now`. Timers that are added meanwhile wait for the next call, even if they are due.
  void run_due(Time now);

 private:
  std::map<std::pair<Time, Id>, std::function<void()>> timers_;
  std::unordered_map<Id, Time> due_;
  Id next_ = 1;
};

}  // namespace roci::services
