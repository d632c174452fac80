// How much of a resource every plan still takes, at least: measured once for all states of the task without
// time and numbers (TimelessSpace), by a search from the initial state by what is taken so far, and one back
// from the goals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/timeless_space.hpp"
#include "planner_svc/temporal_pddl/task/resources.hpp"

namespace roci::planner::temporal_pddl {

class ResourceNeed {
 public:
  // `left`: how much may be taken from the initial state on. None: more than max_states states lie within it.
  // `step` is called for each state with the bytes in use, and may throw.
  static std::optional<ResourceNeed> measure(const Task& task, TimelessSpace space, const Resource& resource,
                                             std::size_t max_states,
                                             const std::function<void(std::size_t)>& step);

  // What a plan through this state takes from here on, at least. Infinite: more than there ever was. 0 where
  // nothing is known.
  double of(StateView state, std::span<const ActionId> running);
  // From the initial state on.
  double at_first() const { return std::min(needs_.front(), beyond_); }
  std::size_t states() const { return needs_.size(); }
  std::size_t bytes() const;

 private:
  explicit ResourceNeed(TimelessSpace space) : space_(std::move(space)), slots_(1024, kFree) {}

  static constexpr std::uint32_t kFree = 0xffffffff;
  struct Edge {
    std::uint32_t from, to;
    double taken;
  };

  bool explore(const Task& task, const Resource& resource, std::size_t max_states,
               const std::function<void(std::size_t)>& step);
  void measure_back(const std::function<void(std::size_t)>& step);
  std::span<const Word> key(std::uint32_t node) const {
    return std::span(keys_).subspan(node * space_.key_words(), space_.key_words());
  }
  std::size_t bytes_while_measured(std::size_t queued) const;
  std::size_t slot_of(std::span<const Word> key) const;
  std::uint32_t intern(std::span<const Word> key);

  TimelessSpace space_;
  std::vector<Word> keys_;                                   // by node
  std::vector<std::uint32_t> slots_;                         // open addressing, a power of two
  std::vector<double> needs_;                                // by node
  double beyond_ = std::numeric_limits<double>::infinity();  // all states that take less are known
  std::vector<double> taken_;                                // by node, up to it; while it is measured
  std::vector<bool> settled_;                                // likewise: its successors are known
  std::vector<Edge> edges_;                                  // likewise
  TimelessSpace::Key asked_;
};

}  // namespace roci::planner::temporal_pddl
