// This file takes numbers into the relaxed task: which comparisons operators and goals ask for, and which
// operators bring them nearer.
//
// What one application does to a comparison is taken as the state at hand has it, and repeated as often as it
// takes; what lowers it is left out (subgoaling-based relaxation, after Scala, Haslum and Thiébaux 2016).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using ComparisonId = task::Id<struct ComparisonTag>;

/// Is an operator that may make a comparison true.
struct NumericAchiever {
  ComparisonId comparison;
  task::SnapId op;
};

/// Holds the comparisons of a task, numbered from 0. The task must outlive it.
class NumericRelaxation {
 public:
  explicit NumericRelaxation(const task::Task& task);

  /// Returns how many comparisons there are. Those in which ?duration occurs, and invariants that the start
  /// itself changes, are left out.
  std::size_t comparisons() const { return conditions_.size(); }
  std::span<const ComparisonId> needs(task::SnapId op) const { return needs_[op]; }
  std::span<const ComparisonId> needs(const task::Goal& goal) const {
    return goal_needs_[static_cast<std::size_t>(&goal - task_.goals.data())];
  }
  std::span<const task::SnapId> needed_by(ComparisonId comparison) const { return needed_by_[comparison]; }
  /// Returns, among others, every comparison that an application of `op` may make true in some state.
  std::span<const NumericAchiever> raises(task::SnapId op) const { return raises_[op]; }

  std::size_t bytes() const {
    return needs_.bytes() + touches_.bytes() + needed_by_.bytes() + raises_.bytes();
  }
  /// Returns the comparisons that an application may change, for better or worse.
  std::span<const ComparisonId> touches(task::SnapId op) const { return touches_[op]; }

  bool holds(ComparisonId comparison, task::StateView state) const {
    return satisfies(comparison, value(comparison, state));
  }
  /// Returns the difference that is compared with 0.
  double value(ComparisonId comparison, task::StateView state) const;
  bool satisfies(ComparisonId comparison, double value) const;
  /// Returns by how much an application in this state raises the value; 0 where that cannot be told.
  double change(task::SnapId op, ComparisonId comparison, task::StateView state) const;
  /// Returns the same of a durative action with both its ends.
  double whole_change(task::SnapId op, ComparisonId comparison, task::StateView state) const;
  /// Returns how many applications make the comparison true, which does not hold in the state; 1 if that
  /// cannot be told.
  std::int64_t repeats(const NumericAchiever& raise, task::StateView state) const;

 private:
  // Returns none for comparisons that are left out.
  ComparisonId intern(const task::NumericCondition& condition);
  void find_needs(task::SnapId op);
  void find_changes(task::SnapId op);
  bool changed_by(task::SnapId op, const task::NumericCondition& condition) const;
  const task::LinearExpression& expression(ComparisonId comparison) const {
    return task_.expressions[conditions_[comparison].expression];
  }

  const task::Task& task_;
  task::IdVector<ComparisonId, task::NumericCondition> conditions_;
  std::map<task::NumericCondition, ComparisonId> ids_;
  task::FlatLists<ComparisonId> needs_, goal_needs_, touches_;
  task::FlatLists<task::SnapId> needed_by_;
  task::FlatLists<NumericAchiever> raises_;
};

}  // namespace roci::planner::temporal_pddl::heuristics
