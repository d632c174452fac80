// Orderings say which earlier steps a new step must follow (R22, R23).
//
// Nothing is stored for this: the last modifiers and users of each variable are found by walking the plan
// backwards (R27). A new step j at the end of a plan comes:
// - for a condition or effect on v: ε after the last step with an effect on v;
// - for an effect on v: also ε after the steps with a condition on v since then, and, unless it only adds a
//   fact, not before the ends of actions with an invariant on v (adding what holds anyway never hurts an
//   invariant);
// - for an invariant on v of an action that starts at j: not before the last step with an effect on v.
// While an action with an invariant over several numbers runs, an effect on one of them counts as a condition
// on the others too: every order that the constraints allow must keep the invariant.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::constraints {

/// Finds the orderings of a new step (R22, R23). The task must outlive it.
class Orderings {
 public:
  Orderings(const task::Task& task, temporal::Duration epsilon);

  /// Appends the orderings of a new step that follows `steps`: lower is ε or 0, upper is unbounded, `to` is
  /// steps.size(). There is at most one per earlier step. `running` names the actions that have started and
  /// not ended.
  void add(std::span<const task::SnapId> steps, task::SnapId next, std::span<const task::ActionId> running,
           std::vector<StepConstraint>& constraints);

 private:
  // Says what the new step does with a variable. The step `ends` a variable if it changes it and a later step
  // was met that only adds the fact.
  enum Interest : std::uint8_t { guards = 1, reads = 2, adds = 4, changes = 8, ends = 16 };

  void mark(task::VariableId variable, std::uint8_t interest);
  void mark_new_step(task::SnapId next, std::span<const task::ActionId> running);
  bool only_adds(task::SnapId step, task::VariableId variable) const;
  bool writes(task::SnapId step, task::VariableId variable) const;

  const task::Task& task_;
  temporal::Duration epsilon_;
  task::IdVector<task::VariableId, std::uint8_t> interests_;  // 0 outside of add()
  std::vector<task::VariableId> marked_;
};

}  // namespace roci::planner::temporal_pddl::constraints
