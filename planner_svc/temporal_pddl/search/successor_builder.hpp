// From a state and a snap action to the next state, if there is one.
#pragma once

#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/orderings.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"
#include "planner_svc/temporal_pddl/task/action_steps.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl {

enum class Rejection { none, logical, temporal };

struct Successor {
  Transition transition;
  std::vector<Word> state;
  PlanPrefix prefix;                // of the new state; its node is not set
  std::vector<Ticks> times;         // of the prefix's steps, at the earliest, if build() has scheduled them
  std::size_t new_constraints = 0;  // how many of prefix.constraints the transition added, at their end
};

class SuccessorBuilder {
 public:
  SuccessorBuilder(const Task& task, const StateStore& store, TemporalCheck& check, Duration epsilon,
                   ActionSteps steps)
      : task_(task),
        store_(store),
        check_(check),
        steps_(steps),
        absolute_(task.has_absolute_times()),
        semantics_(task),
        orderings_(task, epsilon) {}

  // Is it worth a try? Conditions hold, and an end belongs to a running action (R11), a start does not, the
  // timed literal is the next one.
  bool applicable(const PlanPrefix& prefix, SnapId snap) const;
  // The state after an applicable snap action: all invariants hold (R13) and the plan can be scheduled (R25).
  // A compression safe action is ended at once (R14). If nothing runs before and after, and only the order of
  // things matters, the new steps can be late enough for everything: then nothing is scheduled.
  Rejection build(const PlanPrefix& prefix, SnapId snap, Successor& successor);
  // As build(), but does not ask whether the plan can be scheduled. False: an invariant breaks, or no
  // duration is possible.
  bool extend(const PlanPrefix& prefix, SnapId snap, Successor& successor);

 private:
  bool take(SnapId snap, double seconds, Successor& successor);
  bool ends_at_once(ActionId action, StateView before) const;
  bool start(ActionId action, NodeId before, Successor& successor);
  bool end(ActionId action, StateView before_start, Successor& successor);
  static bool long_enough(const Successor& successor);
  bool running_invariants_hold(const Successor& successor) const;
  double seconds_of(const Running& running) const;

  const Task& task_;
  const StateStore& store_;
  TemporalCheck& check_;
  ActionSteps steps_;
  bool absolute_;
  Semantics semantics_;
  Orderings orderings_;
};

}  // namespace roci::planner::temporal_pddl
