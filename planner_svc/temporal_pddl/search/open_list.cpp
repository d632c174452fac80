#include "planner_svc/temporal_pddl/search/open_list.hpp"

namespace roci::planner::temporal_pddl {

std::optional<OpenEntry> OpenList::pop() {
  if (size_ == 0) return std::nullopt;
  const bool others_first = queues_[0].served < queues_[1].served;
  const bool others = queues_[1].buckets.empty() || (others_first && !queues_[0].buckets.empty());
  Queue& queue = queues_[others ? 0 : 1];
  ++queue.served;
  --size_;
  const auto best = queue.buckets.begin();
  std::deque<OpenEntry>& bucket = best->second;
  const bool oldest = others || (queue.served / kStreak) % 2 == 0;
  const OpenEntry entry = oldest ? bucket.front() : bucket.back();
  oldest ? bucket.pop_front() : bucket.pop_back();
  if (bucket.empty()) queue.buckets.erase(best);
  return entry;
}

}  // namespace roci::planner::temporal_pddl
