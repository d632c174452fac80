// Successors that wait to be tried, in several queues that take turns; the preferred ones are served first as
// long as that leads on (Helmert 2006, section 6; Richter and Helmert 2009; Röger and Helmert 2010).
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

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

class OpenQueue {
 public:
  // Among equally good entries. streaks: for a while the youngest, which goes on with the plan at hand, then
  // for as long the oldest, which goes back to where there was a choice.
  enum class Order { oldest, streaks };

  explicit OpenQueue(Order order) : order_(order) {}

  void push(Priority priority, OpenEntry entry) {
    buckets_[priority].push_back(entry);
    ++size_;
  }
  // One of the best. The queue must not be empty.
  OpenEntry pop();
  // Takes its turn as if it had been served so many times less.
  void favour(std::int64_t times) { served_ -= times; }
  std::int64_t served() const { return served_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t bytes() const { return size_ * sizeof(OpenEntry); }

 private:
  static constexpr std::int64_t kStreak = 64;

  Order order_;
  std::map<Priority, std::deque<OpenEntry>> buckets_;
  std::int64_t served_ = 0;
  std::size_t size_ = 0;
};

class OpenList {
 public:
  // one_queue: each entry waits in one queue, by its plan's estimate: among the preferred or the others. Else
  // each also waits in a queue by landmarks, and the preferred among all; so it may come several times.
  enum class Sharing { one_queue, all_queues };

  explicit OpenList(Sharing sharing);

  void push(Priority by_plan, Priority by_landmarks, bool preferred, OpenEntry entry);
  // From the queue that was served least.
  std::optional<OpenEntry> pop();
  // The search has made progress: what is preferred is served first for a while.
  void boost();

  std::size_t bytes() const;

 private:
  static constexpr std::int64_t kBoost = 1000;

  struct Kind {
    bool preferred;
    bool by_landmarks;
  };
  bool shared() const { return queues_.size() > 2; }

  std::vector<Kind> kinds_;
  std::vector<OpenQueue> queues_;  // by kind
};

}  // namespace roci::planner::temporal_pddl
