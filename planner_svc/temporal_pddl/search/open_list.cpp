#include "planner_svc/temporal_pddl/search/open_list.hpp"

namespace roci::planner::temporal_pddl {

std::optional<OpenEntry> OpenList::pop() {
  if (size_ == 0) return std::nullopt;
  const bool others_first = queues_[0].served < queues_[1].served;
  Queue& queue =
      queues_[1].buckets.empty() || (others_first && !queues_[0].buckets.empty()) ? queues_[0] : queues_[1];
  ++queue.served;
  --size_;
  const auto best = queue.buckets.begin();
  const OpenEntry entry = best->second.front();
  best->second.pop_front();
  if (best->second.empty()) queue.buckets.erase(best);
  return entry;
}

}  // namespace roci::planner::temporal_pddl
