// Operator costs carry goal-threat penalties: an operator that the planner chooses costs 1, and more if it
// would undo goals that hold.
//
// A relaxed plan does not see that these have to be brought about once more: without the penalty the last
// goals are reached in turns, each at the expense of another. (Goal threats are what Hoffmann 2003 cuts off
// by goal agendas; here they only cost.)
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Holds the cost of each operator in the state at hand. All that it is given must outlive it.
class OperatorCosts {
 public:
  using Cost = std::uint32_t;
  /// Sets what is paid for each goal that an operator would undo, in actions.
  static constexpr Cost kGoalThreatPenalty = 10;

  OperatorCosts(const task::Task& task, const RelaxedTask& relaxed);

  /// Sets the costs by the goals that hold in the state; with several alternatives, by those that all of
  /// them ask for.
  void set(task::StateView state);
  /// Returns the cost. The start of a durative action stands for what both its ends do.
  Cost of(task::SnapId op) const { return costs_[op]; }
  /// Returns the part of the cost that is a penalty.
  Cost threat_penalty(task::SnapId op) const { return costs_[op] - (relaxed_.is_choice(op) ? 1 : 0); }
  std::size_t bytes() const { return costs_.bytes() + undone_by_.bytes(); }

 private:
  const task::Task& task_;
  const RelaxedTask& relaxed_;
  std::vector<task::FactId> goals_;
  task::FlatLists<task::SnapId> undone_by_;  // by position in goals_
  task::IdVector<task::SnapId, Cost> costs_;
  std::vector<task::SnapId> raised_;
};

}  // namespace roci::planner::temporal_pddl::heuristics
