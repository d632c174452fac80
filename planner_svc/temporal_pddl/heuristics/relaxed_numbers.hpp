// Numbers in the relaxed task: which comparisons operators and goals ask for, and which operators bring them
// nearer. What one application does to a comparison is taken as the state at hand has it, and repeated as
// often as it takes; what lowers it is left out (subgoaling, after Scala, Haslum and Thiébaux 2016).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

using ComparisonId = Id<struct ComparisonTag>;

// An operator that may make a comparison true.
struct Raise {
  ComparisonId comparison;
  SnapId op;
};

class RelaxedNumbers {
 public:
  explicit RelaxedNumbers(const Task& task);

  // Comparisons in which ?duration occurs, and invariants that the start itself changes, are left out.
  std::size_t comparisons() const { return conditions_.size(); }
  std::span<const ComparisonId> needs(SnapId op) const { return needs_[op]; }
  std::span<const ComparisonId> needs(const Goal& goal) const {
    return goal_needs_[static_cast<std::size_t>(&goal - task_.goals.data())];
  }
  std::span<const SnapId> needed_by(ComparisonId comparison) const { return needed_by_[comparison]; }
  // Every comparison that an application of `op` may make true in some state is among them.
  std::span<const Raise> raises(SnapId op) const { return raises_[op]; }

  std::size_t bytes() const {
    return needs_.bytes() + touches_.bytes() + needed_by_.bytes() + raises_.bytes();
  }
  // The comparisons that an application may change, for better or worse.
  std::span<const ComparisonId> touches(SnapId op) const { return touches_[op]; }

  bool holds(ComparisonId comparison, StateView state) const {
    return satisfies(comparison, value(comparison, state));
  }
  // The difference that is compared with 0.
  double value(ComparisonId comparison, StateView state) const;
  bool satisfies(ComparisonId comparison, double value) const;
  // By how much an application in this state raises the value; 0 where that cannot be told.
  double change(SnapId op, ComparisonId comparison, StateView state) const;
  // The same of a durative action with both its ends.
  double whole_change(SnapId op, ComparisonId comparison, StateView state) const;
  // How many applications make the comparison true, which does not hold in the state; 1 if that cannot be
  // told.
  std::int64_t repeats(const Raise& raise, StateView state) const;

 private:
  // None: left out.
  ComparisonId intern(const NumericCondition& condition);
  void find_needs(SnapId op);
  void find_changes(SnapId op);
  bool changed_by(SnapId op, const NumericCondition& condition) const;
  const LinearExpression& expression(ComparisonId comparison) const {
    return task_.expressions[conditions_[comparison].expression];
  }

  const Task& task_;
  IdVector<ComparisonId, NumericCondition> conditions_;
  std::map<NumericCondition, ComparisonId> ids_;
  FlatLists<ComparisonId> needs_, goal_needs_, touches_;
  FlatLists<SnapId> needed_by_;
  FlatLists<Raise> raises_;
};

}  // namespace roci::planner::temporal_pddl
