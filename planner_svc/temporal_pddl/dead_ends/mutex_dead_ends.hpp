// This detector proves dead ends by pairs of literals from which the goals are out of reach
// (BackwardH2Mutexes).
//
// Most problems are solved before the tables pay: they are made after a number of evaluations, for the kind
// of search that asks, and given up where they take too much work or memory.
#pragma once

#include <array>
#include <optional>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/dead_ends/backward_h2_mutexes.hpp"
#include "planner_svc/temporal_pddl/dead_ends/dead_end_detector.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Never takes a state with a plan for a dead end (it is safe). The task and the limits must outlive it.
class MutexDeadEnds final : public DeadEndDetector {
 public:
  /// Waits for `patience` evaluations before it makes the tables.
  MutexDeadEnds(const task::Task& task, std::size_t patience, call::SearchLimits& limits)
      : task_(task), patience_(patience), limits_(limits) {}

  bool proves_dead_end(task::StateView state, std::span<const task::ActionId> running,
                       task::ActionCompression compression) override;
  void note_evaluation() override {
    if (patience_ > 0) --patience_;
  }
  std::size_t bytes() const override;

 private:
  struct Table {
    bool tried = false;
    std::optional<BackwardH2Mutexes> pairs;  // none: too dear
  };

  std::optional<BackwardH2Mutexes> find(task::ActionCompression steps);

  const task::Task& task_;
  std::size_t patience_;
  call::SearchLimits& limits_;
  std::array<Table, 2> tables_;  // by ActionCompression
};

}  // namespace roci::planner::temporal_pddl::dead_ends
