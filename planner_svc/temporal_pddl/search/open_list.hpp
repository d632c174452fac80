// Successors that wait to be tried: two queues, ordered by estimate; the preferred one is served
// first as long as that leads on (Helmert 2006, section 6; Richter and Helmert 2009).
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "planner_svc/temporal_pddl/search/state_store.hpp"

namespace roci::planner::temporal_pddl {

struct OpenEntry {
  NodeId parent;
  SnapId snap;
};

// Lower is better.
struct Priority {
  std::int64_t first = 0;
  std::int64_t second = 0;
  auto operator<=>(const Priority&) const = default;
};

class OpenList {
 public:
  void push(Priority priority, bool preferred, OpenEntry entry) {
    queues_[preferred].buckets[priority].push_back(entry);
    ++size_;
  }
  // One of the best of one of the queues. Of the preferred ones for a while the youngest, which goes on with
  // the plan at hand, then for as long the oldest, which goes back to where there was a choice; of the others
  // the oldest.
  std::optional<OpenEntry> pop();
  // The search has made progress: what is preferred is served first for a while.
  void boost() { queues_[1].served -= kBoost; }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(OpenEntry); }

 private:
  static constexpr std::int64_t kBoost = 1000;
  static constexpr std::int64_t kStreak = 64;  // 1 and 16 lose floor-tile, endless ones crew-planning

  struct Queue {
    std::map<Priority, std::deque<OpenEntry>> buckets;
    std::int64_t served = 0;
  };

  Queue queues_[2];  // others, preferred
  std::size_t size_ = 0;
};

}  // namespace roci::planner::temporal_pddl
