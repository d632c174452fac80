// The bucket queue holds propositions by the cost at which they are reached, the cheapest first: it has a
// bucket for each small cost and a heap for the few beyond.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Gives the entries in order of cost; its costs never sink between two restarts.
class BucketQueue {
 public:
  using Cost = std::uint32_t;
  using Entry = std::pair<Cost, PropositionId>;
  static constexpr Cost kMostCost = std::numeric_limits<Cost>::max() - 1;

  BucketQueue() : buckets_(kBuckets) {}
  /// Adds an entry whose cost is no less than that of the entry taken last.
  void push(Cost cost, PropositionId proposition) {
    ++size_;
    if (cost < kBuckets) {
      buckets_[cost].push_back(proposition);
      highest_ = std::max(highest_, cost);
      return;
    }
    beyond_.emplace_back(cost, proposition);
    std::ranges::push_heap(beyond_, std::greater{});
  }
  bool empty() const { return size_ == 0; }
  /// Takes the cheapest entry of a queue that is not empty; among equally cheap ones the oldest.
  Entry pop() {
    --size_;
    while (at_ < kBuckets && taken_ == buckets_[at_].size()) {
      buckets_[at_++].clear();
      taken_ = 0;
    }
    if (at_ < kBuckets) return {at_, buckets_[at_][taken_++]};
    std::ranges::pop_heap(beyond_, std::greater{});
    const Entry entry = beyond_.back();
    beyond_.pop_back();
    return entry;
  }
  /// Empties the queue; costs may begin with 0 again.
  void restart() {
    for (; at_ < kBuckets && at_ <= highest_; ++at_) buckets_[at_].clear();
    beyond_.clear();
    at_ = highest_ = 0;
    taken_ = size_ = 0;
  }

 private:
  static constexpr Cost kBuckets = 1024;

  std::vector<std::vector<PropositionId>> buckets_;
  std::vector<Entry> beyond_;
  Cost at_ = 0;            // the bucket at hand
  Cost highest_ = 0;       // the last one that is not empty
  std::size_t taken_ = 0;  // of the bucket at hand
  std::size_t size_ = 0;
};

}  // namespace roci::planner::temporal_pddl::heuristics
