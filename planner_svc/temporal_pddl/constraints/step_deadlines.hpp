// Timed literals and windows bound until when each step of a plan must have happened. These deadlines are not
// stored, but rebuilt for each check (R34).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::constraints {

/// Gives the latest times that the timed literals to come allow. A timed literal that the plan does not
/// contain yet will follow all its steps (R32): a step that needs or changes what it touches must come ε
/// before; one that needs it as an invariant must end no later. The times of the timed literals themselves
/// are their windows.
class StepDeadlines {
 public:
  StepDeadlines(const task::Task& task, temporal::Duration epsilon);

  /// Returns the latest time of the step, or no_bound, for a plan that contains `timed_done` timed literals.
  temporal::Duration latest(task::SnapId step, std::uint32_t timed_done) const;
  /// Returns the latest start of an action that has not ended in the plan, likewise: its end must also come
  /// before a timed literal deletes one of its invariants.
  temporal::Duration latest_running(task::SnapId start, std::uint32_t timed_done) const;

 private:
  temporal::Duration time_of(std::uint32_t timed_step) const;

  const task::Task& task_;
  temporal::Duration epsilon_;
  // Lists the timed steps that touch a variable, in ascending order.
  task::IdVector<task::VariableId, std::vector<std::uint32_t>> timed_;
  // Lists those that touch it other than by adding a fact.
  task::IdVector<task::VariableId, std::vector<std::uint32_t>> timed_change_;
  // Tells whether some timed step touches a variable of the snap action or of its invariants.
  task::IdVector<task::SnapId, bool> touched_;
};

}  // namespace roci::planner::temporal_pddl::constraints
