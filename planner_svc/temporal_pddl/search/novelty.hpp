// Novelty tells how new a state is: of how many of its facts no state with so low an estimate has been seen
// before (Katz, Lipovetzky, Moshkovich and Tuisov 2017). It leads out of where an estimate does not fall any
// more.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Remembers for each fact the lowest estimate with which it was seen. The task must outlive it.
class Novelty {
 public:
  explicit Novelty(const task::Task& task)
      : task_(task),
        lowest_(task.fact_names.size(), kUnseen),
        lowest_running_(task.actions.size(), kUnseen) {}

  /// Returns the novelty of a state and the actions that run in it, which count as facts; from now on it has
  /// been seen.
  std::int64_t see(task::StateView state, std::span<const task::ActionId> running, std::int64_t estimate);
  std::size_t bytes() const { return (lowest_.size() + lowest_running_.size()) * sizeof(std::int64_t); }

 private:
  static constexpr std::int64_t kUnseen = std::numeric_limits<std::int64_t>::max();

  const task::Task& task_;
  task::IdVector<task::FactId, std::int64_t> lowest_;  // estimate of a state with the fact
  task::IdVector<task::ActionId, std::int64_t> lowest_running_;
};

}  // namespace roci::planner::temporal_pddl::search
