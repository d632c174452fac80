// This file takes numbers into the relaxed task: which comparisons operators and goals ask for, and which
// operators bring them nearer.
//
// What one application does to a comparison is taken as the state at hand has it, and repeated as often as it
// takes; what lowers it is left out (subgoaling-based relaxation, after Scala, Haslum and Thiébaux 2016).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using ComparisonId = task::Id<struct ComparisonTag>;

/// What comparisons have in common that differ in their constant and comparator alone: what changes one of them changes
/// all by as much.
using FormId = task::Id<struct FormTag>;

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
  std::span<const ComparisonId> raises(task::SnapId op) const { return raised_[raises_[op]]; }

  std::size_t forms() const { return of_form_.size(); }
  FormId form(ComparisonId comparison) const { return forms_[comparison]; }
  /// Returns the forms of the comparisons that an application may change, for better or worse.
  std::span<const FormId> touches(task::SnapId op) const { return touches_[op]; }

  std::size_t bytes() const;

  bool holds(ComparisonId comparison, task::StateView state) const {
    return satisfies(comparison, value(comparison, state));
  }
  /// Returns the difference that is compared with 0.
  double value(ComparisonId comparison, task::StateView state) const;
  bool satisfies(ComparisonId comparison, double value) const;
  /// Returns by how much an application in this state raises the values of a form; 0 where that cannot be told.
  double change(task::SnapId op, FormId form, task::StateView state) const;
  /// Returns the same of a durative action with both its ends.
  double whole_change(task::SnapId op, FormId form, task::StateView state) const;
  /// Returns how many applications make the comparison true, which does not hold in the state; 1 if that
  /// cannot be told.
  std::int64_t repeats(task::SnapId op, ComparisonId comparison, task::StateView state) const;

 private:
  // Whether an operator may make all comparisons of a form true, or those alone that ask for one value.
  using Raise = std::pair<FormId, bool>;

  // Returns none for comparisons that are left out.
  ComparisonId intern(const task::NumericCondition& condition);
  void find_forms();
  void find_needs(task::SnapId op);
  void find_changes(task::SnapId op);
  bool raises_all(task::SnapId op, FormId form) const;
  std::uint32_t intern_raised(std::vector<Raise> raises);
  bool changed_by(task::SnapId op, const task::LinearExpression& expression) const;
  const task::LinearExpression& expression(ComparisonId comparison) const {
    return task_.expressions[conditions_[comparison].expression];
  }
  // One of those that have the form.
  const task::LinearExpression& expression(FormId form) const { return expression(of_form_[form].front()); }

  const task::Task& task_;
  task::IdVector<ComparisonId, task::NumericCondition> conditions_;
  std::map<task::NumericCondition, ComparisonId> ids_;
  task::IdVector<ComparisonId, FormId> forms_;
  task::FlatLists<ComparisonId> of_form_;
  task::FlatLists<ComparisonId> needs_, goal_needs_;
  task::FlatLists<task::SnapId> needed_by_;
  task::FlatLists<FormId> touches_;
  task::FlatLists<ComparisonId> raised_;  // mostly many operators share one
  std::map<std::vector<Raise>, std::uint32_t> raised_by_;
  task::IdVector<task::SnapId, std::uint32_t> raises_;  // in raised_
};

}  // namespace roci::planner::temporal_pddl::heuristics
