#include "planner_svc/temporal_pddl/search/open_list.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using task::SnapId;

namespace {

constexpr std::int64_t kStreak = 64;

}  // namespace

OpenList::OpenList(Kinds kinds) {
  const auto add = [&](Priority Ranks::*rank) {
    queues_.push_back({true, rank, Order::streaks});
    queues_.push_back({false, rank, Order::oldest});
  };
  add(&Ranks::by_plan);
  if (kinds.by_landmarks) add(&Ranks::by_landmarks);
  if (kinds.by_novelty) add(&Ranks::by_novelty);
}

void OpenList::push(const Ranks& ranks, NodeId parent, std::span<const SnapId> successors,
                    std::span<const SnapId> preferred) {
  if (successors_.size() <= parent.index()) successors_.resize(parent.index() + 1);
  Successors& own = successors_[parent.index()];
  own.size = static_cast<std::uint32_t>(successors.size());
  own.list = std::make_unique_for_overwrite<Successor[]>(own.size);
  for (std::uint32_t i = 0; i < own.size; ++i)
    own.list[i] = {successors[i].value, std::ranges::binary_search(preferred, successors[i]), false};
  list_bytes_ += bytes(own);
  for (Queue& queue : queues_) {
    Run run{parent, 0, own.size};
    trim(queue, run);
    if (run.begin == run.end) continue;
    queue.runs.push(ranks.*queue.rank, run);
    ++own.runs;
  }
}

bool OpenList::waits(const Queue& queue, Successor successor) const {
  const bool alone = queues_.size() == 2;
  return queue.preferred ? successor.preferred : !alone || !successor.preferred;
}

void OpenList::trim(const Queue& queue, Run& run) const {
  const Successor* list = successors_[run.parent.index()].list.get();
  while (run.begin < run.end && !waits(queue, list[run.begin])) ++run.begin;
  while (run.begin < run.end && !waits(queue, list[run.end - 1])) --run.end;
}

std::optional<OpenEntry> OpenList::pop() {
  while (true) {
    Queue* next = nullptr;
    for (Queue& queue : queues_) {
      if (!queue.runs.empty() && (!next || queue.served < next->served)) next = &queue;
    }
    if (!next) return std::nullopt;
    if (const auto entry = serve(*next)) return entry;
  }
}

// Takes the next entry of the queue. Returns nothing if it has been tried from another queue.
std::optional<OpenEntry> OpenList::serve(Queue& queue) {
  ++queue.served;
  const bool oldest = queue.order == Order::oldest || (queue.served / kStreak) % 2 == 0;
  Run& run = oldest ? queue.runs.oldest() : queue.runs.youngest();
  const NodeId parent = run.parent;
  Successor& served = successors_[parent.index()].list[oldest ? run.begin++ : --run.end];
  const bool tried = served.tried;
  served.tried = true;
  const OpenEntry entry{parent, SnapId(std::size_t{served.snap})};
  trim(queue, run);
  if (run.begin == run.end) {
    oldest ? queue.runs.drop_oldest() : queue.runs.drop_youngest();
    release(parent);
  }
  if (tried) return std::nullopt;
  return entry;
}

void OpenList::release(NodeId parent) {
  Successors& own = successors_[parent.index()];
  if (--own.runs > 0) return;
  list_bytes_ -= bytes(own);
  own = {};
}

void OpenList::boost() {
  for (Queue& queue : queues_) {
    if (queue.preferred) queue.served -= kBoost;
  }
}

// Returns the bytes of the list, with the allocator's share.
std::size_t OpenList::bytes(const Successors& successors) {
  return successors.size * sizeof(Successor) + 2 * sizeof(void*);
}

std::size_t OpenList::bytes() const {
  std::size_t result = successors_.capacity() * sizeof(Successors) + list_bytes_;
  for (const Queue& queue : queues_) result += queue.runs.bytes();
  return result;
}

}  // namespace roci::planner::temporal_pddl::search
