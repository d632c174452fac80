#include "planner_svc/temporal_pddl/search/open_list.hpp"

namespace roci::planner::temporal_pddl {

OpenEntry OpenQueue::pop() {
  ++served_;
  --size_;
  const auto best = buckets_.begin();
  std::deque<OpenEntry>& bucket = best->second;
  const bool oldest = order_ == Order::oldest || (served_ / kStreak) % 2 == 0;
  const OpenEntry entry = oldest ? bucket.front() : bucket.back();
  oldest ? bucket.pop_front() : bucket.pop_back();
  if (bucket.empty()) buckets_.erase(best);
  return entry;
}

OpenList::OpenList(Sharing sharing) : kinds_{{true, false}, {false, false}} {
  if (sharing == Sharing::all_queues) kinds_.insert(kinds_.end(), {{true, true}, {false, true}});
  for (const Kind& kind : kinds_) {
    queues_.emplace_back(kind.preferred ? OpenQueue::Order::streaks : OpenQueue::Order::oldest);
  }
}

void OpenList::push(Priority by_plan, Priority by_landmarks, bool preferred, OpenEntry entry) {
  for (std::size_t i = 0; i < queues_.size(); ++i) {
    const Kind& kind = kinds_[i];
    const bool waits = kind.preferred ? preferred : shared() || !preferred;
    if (waits) queues_[i].push(kind.by_landmarks ? by_landmarks : by_plan, entry);
  }
}

std::optional<OpenEntry> OpenList::pop() {
  OpenQueue* next = nullptr;
  for (OpenQueue& queue : queues_) {
    if (!queue.empty() && (!next || queue.served() < next->served())) next = &queue;
  }
  if (!next) return std::nullopt;
  return next->pop();
}

void OpenList::boost() {
  for (std::size_t i = 0; i < queues_.size(); ++i) {
    if (kinds_[i].preferred) queues_[i].favour(kBoost);
  }
}

std::size_t OpenList::bytes() const {
  std::size_t result = 0;
  for (const OpenQueue& queue : queues_) result += queue.bytes();
  return result;
}

}  // namespace roci::planner::temporal_pddl
