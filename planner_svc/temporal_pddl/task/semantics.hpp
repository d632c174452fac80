// The semantics says what a snap action asks of a state and does to it.
#pragma once

#include <optional>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::task {

/// Bounds the duration of an action in one state.
struct DurationBounds {
  temporal::Duration min{0};
  temporal::Duration max = temporal::no_bound;
  double seconds = 0;  ///< the exact ?duration where it is fixed, else the least one
};

/// Applies snap actions to states of one task, which must outlive it.
class Semantics {
 public:
  explicit Semantics(const Task& task) : task_(task) {}

  /// Returns whether pre⊢ or pre⊣ holds; `seconds` is the value of ?duration.
  bool applicable(SnapId snap, StateView state, double seconds) const;
  /// Returns whether pre↔ holds.
  bool invariants_hold(ActionId action, StateView state, double seconds) const;
  /// Applies all effects at once, as seen from the state before.
  void apply(SnapId snap, double seconds, MutableState state) const;
  /// Returns the bounds on the duration, or nothing if no duration satisfies all of them. A bound measured
  /// at the end needs the state before the end; without one it is left out.
  std::optional<DurationBounds> duration(ActionId action, StateView before_start,
                                         std::optional<StateView> before_end) const;
  bool satisfied(const NumericCondition& condition, StateView state) const;
  bool satisfied(const Goal& goal, StateView state) const;
  bool goal_satisfied(StateView state) const;

 private:
  bool holds_all(std::span<const FactId> facts, StateView state) const;
  bool holds_all(std::span<const NumericCondition> conditions, StateView state, double seconds) const;

  const Task& task_;
};

/// Returns whether the fact is false after the action as a whole, whatever it was before.
bool undoes(const Task& task, const Action& action, FactId fact);

}  // namespace roci::planner::temporal_pddl::task
