// The consumption bound tells how much of a resource every plan still takes, at least: it is the perfect
// heuristic of an abstraction.
//
// It is measured once for all states of the AtemporalAbstraction, by a search from the initial state by what
// is taken so far, and one back from the goals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/atemporal_abstraction.hpp"
#include "planner_svc/temporal_pddl/task/consumable_resources.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Holds the bound of all measured states; it never exceeds what a plan really takes.
class ConsumptionBound {
 public:
  /// Measures the bound, or returns nothing if more than max_states states lie within what may be taken.
  /// `step` is called for each state with the bytes in use, and may throw.
  static std::optional<ConsumptionBound> measure(const task::Task& task, AtemporalAbstraction space,
                                                 const task::ConsumableResource& resource,
                                                 std::size_t max_states,
                                                 const std::function<void(std::size_t)>& step);

  /// Returns what a plan through this state takes from here on, at least: infinity for more than there ever
  /// was, 0 where nothing is known.
  double of(task::StateView state, std::span<const task::ActionId> running);
  /// Returns the bound from the initial state on.
  double at_first() const { return std::min(needs_.front(), beyond_); }
  std::size_t states() const { return needs_.size(); }
  std::size_t bytes() const;

 private:
  explicit ConsumptionBound(AtemporalAbstraction space) : space_(std::move(space)), slots_(1024, kFree) {}

  static constexpr std::uint32_t kFree = 0xffffffff;
  struct Edge {
    std::uint32_t from, to;
    double taken;
  };

  bool explore(const task::Task& task, const task::ConsumableResource& resource, std::size_t max_states,
               const std::function<void(std::size_t)>& step);
  void measure_back(const std::function<void(std::size_t)>& step);
  std::span<const task::Word> key(std::uint32_t node) const {
    return std::span(keys_).subspan(node * space_.key_words(), space_.key_words());
  }
  std::size_t bytes_while_measured(std::size_t queued) const;
  std::size_t slot_of(std::span<const task::Word> key) const;
  std::uint32_t intern(std::span<const task::Word> key);

  AtemporalAbstraction space_;
  std::vector<task::Word> keys_;                             // by node
  std::vector<std::uint32_t> slots_;                         // open addressing, a power of two
  std::vector<double> needs_;                                // by node
  double beyond_ = std::numeric_limits<double>::infinity();  // all states that take less are known
  std::vector<double> taken_;                                // by node, up to it; while it is measured
  std::vector<bool> settled_;                                // likewise: its successors are known
  std::vector<Edge> edges_;                                  // likewise
  AtemporalAbstraction::Key asked_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
