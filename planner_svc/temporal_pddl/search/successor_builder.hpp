// The successor builder leads from a state and a snap action to the next state, if there is one.
#pragma once

#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/orderings.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"
#include "planner_svc/temporal_pddl/task/action_compression.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::search {

/// Says why a snap action leads to no state.
enum class Rejection { none, logical, temporal };

/// Holds a state that has been built and may be stored.
struct Successor {
  Transition transition;
  std::vector<task::Word> state;
  PlanPrefix prefix;  ///< is that of the new state; its node is not set
  /// Holds the earliest times of the steps of the prefix, if build() has scheduled them.
  std::vector<temporal::Duration> times;
  std::size_t new_constraints = 0;  ///< counts the prefix.constraints that the transition added, at their end
};

/// Builds successors of stored states. All that it is given must outlive it.
class SuccessorBuilder {
 public:
  SuccessorBuilder(const task::Task& task, const StateStore& store, TemporalCheck& check,
                   temporal::Duration epsilon, task::ActionCompression steps)
      : task_(task),
        store_(store),
        check_(check),
        steps_(steps),
        absolute_(task.has_absolute_times()),
        semantics_(task),
        orderings_(task, epsilon) {}

  /// Returns whether the snap action is worth a try: its conditions hold, an end belongs to a running action
  /// (R11), a start does not, and a timed literal is the next one.
  bool applicable(const PlanPrefix& prefix, task::SnapId snap) const;
  /// Builds the state after an applicable snap action: all invariants must hold (R13) and the plan must be
  /// schedulable (R25). A compression safe action is ended at once (R14). If nothing runs before and after,
  /// and only the order of things matters, the new steps can be late enough for everything, and nothing is
  /// scheduled.
  Rejection build(const PlanPrefix& prefix, task::SnapId snap, Successor& successor);
  /// Builds the state likewise, but does not ask whether the plan can be scheduled. Returns false if an
  /// invariant breaks, or no duration is possible.
  bool extend(const PlanPrefix& prefix, task::SnapId snap, Successor& successor);

  /// Builds likewise, but `plan`, which holds the stored state that its node names, becomes its own successor:
  /// no step of it is copied, so that a step costs the same however long the plan is, unless it has to be
  /// scheduled. Rejected, the plan is as it was.
  Rejection advance(task::SnapId snap, Successor& plan);
  /// Does likewise, but does not ask whether the plan can be scheduled.
  bool advance_unscheduled(task::SnapId snap, Successor& plan);
  /// Takes the last advance() of the plan back; nothing may have been done with the plan since.
  void take_back(Successor& plan);

 private:
  // Is what a plan was before its last advance, but for its steps and constraints, which are only cut off.
  struct Before {
    Transition transition;
    std::size_t steps = 0, constraints = 0, new_constraints = 0;
    std::vector<Running> running;
    std::vector<task::ActionId> running_actions;
    std::uint32_t timed_done = 0;
    std::vector<temporal::Duration> times;
  };

  void remember(Successor& plan);
  bool append(task::SnapId snap, Successor& successor);
  Rejection schedule(bool idle_before, Successor& successor);
  bool take(task::SnapId snap, double seconds, Successor& successor);
  bool ends_at_once(task::ActionId action, task::StateView before) const;
  bool start(task::ActionId action, NodeId before, Successor& successor);
  bool end(task::ActionId action, task::StateView before_start, Successor& successor);
  static bool long_enough(const Successor& successor);
  bool running_invariants_hold(const Successor& successor) const;
  double seconds_of(const Running& running) const;

  const task::Task& task_;
  const StateStore& store_;
  TemporalCheck& check_;
  task::ActionCompression steps_;
  bool absolute_;
  task::Semantics semantics_;
  constraints::Orderings orderings_;
  Before before_;
};

}  // namespace roci::planner::temporal_pddl::search
