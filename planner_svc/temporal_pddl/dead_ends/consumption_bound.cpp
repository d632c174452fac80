#include "planner_svc/temporal_pddl/dead_ends/consumption_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace roci::planner::temporal_pddl::dead_ends {

using task::ActionId, task::ConsumableResource, task::SnapId, task::StateView, task::Task, task::Word;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Entry = std::pair<double, std::uint32_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

std::uint64_t hash(std::span<const Word> key) {
  std::uint64_t result = 0x9e3779b97f4a7c15ull;
  for (const Word word : key) {
    result = (result ^ word) * 0xff51afd7ed558ccdull;
    result ^= result >> 32;
  }
  return result;
}

}  // namespace

std::optional<ConsumptionBound> ConsumptionBound::measure(const Task& task, AtemporalAbstraction space,
                                                          const ConsumableResource& resource,
                                                          std::size_t max_states,
                                                          const std::function<void(std::size_t)>& step) {
  ConsumptionBound result(std::move(space));
  if (!result.explore(task, resource, max_states, step)) return std::nullopt;
  result.measure_back(step);
  return result;
}

// Goes in order of what is taken: when the states get too many, all within some amount are known.
bool ConsumptionBound::explore(const Task& task, const ConsumableResource& resource, std::size_t max_states,
                               const std::function<void(std::size_t)>& step) {
  const double left = resource.left(task, task.initial_state);
  Queue queue;
  const auto reach = [&](std::span<const Word> key, double taken) {
    const std::uint32_t node = intern(key);
    if (taken < taken_[node]) {
      taken_[node] = taken;
      queue.emplace(taken, node);
    }
    return node;
  };
  if (!space_.project(task.initial_state, {}, asked_)) return false;
  reach(asked_, 0);
  std::vector<Word> at;
  std::size_t settled = 0;
  while (!queue.empty()) {
    const auto [taken, node] = queue.top();
    queue.pop();
    if (settled_[node]) continue;
    if (settled == max_states) {
      beyond_ = taken;
      return taken > left + 1e-6 * (1 + std::abs(left));
    }
    step(bytes_while_measured(queue.size()));
    settled_[node] = true;
    ++settled;
    const auto here = key(node);
    at.assign(here.begin(), here.end());
    const bool complete =
        space_.each_successor(at, [&, here_taken = taken, from = node](SnapId snap, bool compressed) {
          double more = resource.taken[snap];
          if (compressed) more += resource.taken[task.actions[task.snaps[snap].action].end];
          edges_.push_back({from, reach(space_.next(), here_taken + more), more});
        });
    if (!complete) return false;
  }
  return true;
}

void ConsumptionBound::measure_back(const std::function<void(std::size_t)>& step) {
  // Puts the edges into each node next to each other.
  std::vector<std::uint32_t> first(taken_.size() + 1, 0);
  for (const Edge& edge : edges_) ++first[edge.to + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::pair<std::uint32_t, double>> incoming(edges_.size());
  auto place = first;
  for (const Edge& edge : edges_) incoming[place[edge.to]++] = {edge.from, edge.taken};
  edges_ = {};
  needs_.assign(taken_.size(), kInfinite);
  const std::size_t while_measured = bytes_while_measured(0) + first.capacity() * sizeof(first.front()) +
                                     place.capacity() * sizeof(place.front()) +
                                     incoming.capacity() * sizeof(incoming.front());
  Queue queue;
  for (std::uint32_t node = 0; node < needs_.size(); ++node) {
    if (!space_.is_goal(key(node))) continue;
    needs_[node] = 0;
    queue.emplace(0, node);
  }
  while (!queue.empty()) {
    const auto [need, node] = queue.top();
    queue.pop();
    if (need > needs_[node]) continue;
    step(while_measured + queue.size() * sizeof(Queue::value_type));
    for (std::size_t i = first[node]; i < first[node + 1]; ++i) {
      const auto [from, taken] = incoming[i];
      if (need + taken >= needs_[from]) continue;
      needs_[from] = need + taken;
      queue.emplace(needs_[from], from);
    }
  }
  taken_ = {};
  settled_ = {};
}

double ConsumptionBound::of(StateView state, std::span<const ActionId> running) {
  if (!space_.project(state, running, asked_)) return 0;
  const std::uint32_t node = slots_[slot_of(asked_)];
  return node == kFree ? 0 : needs_[node];
}

std::size_t ConsumptionBound::bytes() const {
  return keys_.capacity() * sizeof(Word) + slots_.capacity() * sizeof(std::uint32_t) +
         needs_.capacity() * sizeof(double);
}

std::size_t ConsumptionBound::bytes_while_measured(std::size_t queued) const {
  return bytes() + taken_.capacity() * sizeof(double) + settled_.capacity() / 8 +
         2 * edges_.capacity() * sizeof(Edge) +  // when they grow, and when they are sorted
         queued * sizeof(Queue::value_type);
}

std::size_t ConsumptionBound::slot_of(std::span<const Word> wanted) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(wanted) & mask;
  while (slots_[slot] != kFree && !std::ranges::equal(key(slots_[slot]), wanted)) slot = (slot + 1) & mask;
  return slot;
}

std::uint32_t ConsumptionBound::intern(std::span<const Word> wanted) {
  std::size_t slot = slot_of(wanted);
  if (slots_[slot] != kFree) return slots_[slot];
  const auto node = static_cast<std::uint32_t>(taken_.size());
  keys_.insert(keys_.end(), wanted.begin(), wanted.end());
  taken_.push_back(kInfinite);
  settled_.push_back(false);
  slots_[slot] = node;
  if (2 * taken_.size() > slots_.size()) {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::uint32_t i = 0; i <= node; ++i) slots_[slot_of(key(i))] = i;
  }
  return node;
}

}  // namespace roci::planner::temporal_pddl::dead_ends
