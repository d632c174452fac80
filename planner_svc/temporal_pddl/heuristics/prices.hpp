// What an operator counts, in actions: one that the planner chooses 1, and more if it would undo goals that
// hold. A relaxed plan does not see that these have to be brought about once more: without a price on it the
// last goals are reached in turns, each at the expense of another.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class Prices {
 public:
  using Price = std::uint32_t;
  static constexpr Price kUndone = 10;  // a goal

  Prices(const Task& task, const RelaxedTask& relaxed);

  // By the goals that hold in the state; with several alternatives, those that all of them ask for.
  void set(StateView state);
  // Of a durative action, its start counts, and stands for what both do.
  Price of(SnapId op) const { return prices_[op]; }
  // The part that is for goals.
  Price of_undoing(SnapId op) const { return prices_[op] - (relaxed_.is_choice(op) ? 1 : 0); }
  std::size_t bytes() const { return prices_.bytes() + undone_by_.bytes(); }

 private:
  const Task& task_;
  const RelaxedTask& relaxed_;
  std::vector<FactId> goals_;
  FlatLists<SnapId> undone_by_;  // by position in goals_
  IdVector<SnapId, Price> prices_;
  std::vector<SnapId> raised_;
};

}  // namespace roci::planner::temporal_pddl
