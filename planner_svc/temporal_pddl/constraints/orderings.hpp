// Which earlier steps a new step must follow (R22, R23).
//
// Nothing is stored for this: the last modifiers and users of each variable are found by walking the plan
// backwards (R27). For a new step j at the end of a plan:
//  - a condition or effect on v: ε after the last step with an effect on v;
//  - an effect on v: also ε after the steps with a condition on v since then, and, unless it only adds a
//  fact, not
//    before the ends of actions with an invariant on v (adding what holds anyway never hurts an invariant);
//  - an invariant on v of an action that starts at j: not before the last step with an effect on v.
// While an action with an invariant over several numbers runs, an effect on one of them counts as a condition
// on the others too: every order that the constraints allow must keep the invariant.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class Orderings {
 public:
  Orderings(const Task& task, Duration epsilon);

  // Appends the orderings of a new step that follows `steps`: lower is ε or 0, upper is unbounded, to is
  // steps.size(). At most one per earlier step. running: the actions that have started and not ended.
  void add(std::span<const SnapId> steps, SnapId next, std::span<const ActionId> running,
           std::vector<StepConstraint>& constraints);

 private:
  // What the new step does with a variable. ends: it changes it, and a later step that only adds the fact
  // was met.
  enum Interest : std::uint8_t { guards = 1, reads = 2, adds = 4, changes = 8, ends = 16 };

  void mark(VariableId variable, std::uint8_t interest);
  void mark_new_step(SnapId next, std::span<const ActionId> running);
  bool only_adds(SnapId step, VariableId variable) const;
  bool writes(SnapId step, VariableId variable) const;

  const Task& task_;
  Duration epsilon_;
  IdVector<VariableId, std::uint8_t> interests_;  // 0 outside of add()
  std::vector<VariableId> marked_;
};

}  // namespace roci::planner::temporal_pddl
