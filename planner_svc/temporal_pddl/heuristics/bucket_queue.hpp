// Propositions by the cost at which they are reached, cheapest first: a bucket for each small cost, a heap
// for the few beyond.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl {

class BucketQueue {
 public:
  using Entry = std::pair<std::int64_t, PropositionId>;

  BucketQueue() : buckets_(kBuckets) {}
  // cost: no less than that of the entry taken last.
  void push(std::int64_t cost, PropositionId proposition) {
    ++size_;
    if (cost < static_cast<std::int64_t>(kBuckets)) {
      buckets_[static_cast<std::size_t>(cost)].push_back(proposition);
      return;
    }
    beyond_.emplace_back(cost, proposition);
    std::ranges::push_heap(beyond_, std::greater{});
  }
  bool empty() const { return size_ == 0; }
  // Of what is not empty. Among equally cheap ones the oldest.
  Entry pop() {
    --size_;
    while (at_ < kBuckets && taken_ == buckets_[at_].size()) {
      buckets_[at_++].clear();
      taken_ = 0;
    }
    if (at_ < kBuckets) return {static_cast<std::int64_t>(at_), buckets_[at_][taken_++]};
    std::ranges::pop_heap(beyond_, std::greater{});
    const Entry entry = beyond_.back();
    beyond_.pop_back();
    return entry;
  }
  // Once it is empty.
  void restart() {
    if (at_ < kBuckets) buckets_[at_].clear();
    at_ = taken_ = 0;
  }

 private:
  static constexpr std::size_t kBuckets = 1024;

  std::vector<std::vector<PropositionId>> buckets_;
  std::vector<Entry> beyond_;
  std::size_t at_ = 0;     // the bucket at hand
  std::size_t taken_ = 0;  // of it
  std::size_t size_ = 0;
};

}  // namespace roci::planner::temporal_pddl
