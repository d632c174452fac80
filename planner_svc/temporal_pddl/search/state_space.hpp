// The state space holds the states that a search has stored and leads from one to the next; every search over
// plans shares it, whatever its order of expansion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/successor_generator.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl::search {

/// Stores states and builds their successors, for one search. The task must outlive it.
class StateSpace {
 public:
  /// `touched`: see call::SearchLimits::mark_touched(); null: nobody asks.
  StateSpace(const task::Task& task, temporal::Duration epsilon, task::ActionCompression steps,
             std::vector<bool>* touched = nullptr)
      : task_(task),
        steps_(steps),
        epsilon_(epsilon),
        store_(task.layout.words()),
        check_(task, epsilon),
        builder_(task, store_, check_, epsilon, steps),
        tree_(task),
        touched_(touched) {}
  StateSpace(const StateSpace&) = delete;
  StateSpace& operator=(const StateSpace&) = delete;

  /// Rebuilds the plan to a stored state.
  void restore(NodeId node, PlanPrefix& prefix) const {
    rebuild(task_, store_, bounds_, epsilon_, node, prefix);
  }
  /// Returns the snap actions that are applicable after the plan to a stored state: first the ends of what
  /// runs, then starts and plain actions, then the next timed literal. They are valid until the next call.
  std::span<const task::SnapId> applicable(const PlanPrefix& prefix);
  /// Returns whether it is worth a try after the plan to a stored state.
  bool possible(const PlanPrefix& prefix, task::SnapId snap) const {
    return builder_.applicable(prefix, snap);
  }
  Rejection build(const PlanPrefix& prefix, task::SnapId snap, Successor& successor) {
    return builder_.build(prefix, snap, successor);
  }
  /// Takes the snap action after a plan whose node is stored, and stores the state that it leads to: `plan`
  /// becomes its own successor, see SuccessorBuilder::advance(). Rejected, it is as it was; so it is if it
  /// would be too long (R30).
  enum class Advance { done, rejected, too_long };
  Advance advance(task::SnapId snap, Successor& plan);
  /// Stores the successor of `parent` (none for the initial state) and names its node in its prefix.
  NodeId add(NodeId parent, Successor& successor);

  /// Forgets all states.
  void clear() { store_.clear(); }

  task::ActionCompression steps() const { return steps_; }
  const StateStore& store() const { return store_; }
  const constraints::BoundTable& bounds() const { return bounds_; }
  TemporalCheck& check() { return check_; }

 private:
  const task::Task& task_;
  task::ActionCompression steps_;
  temporal::Duration epsilon_;
  StateStore store_;
  constraints::BoundTable bounds_;
  TemporalCheck check_;
  SuccessorBuilder builder_;
  SuccessorGenerator tree_;
  std::vector<bool>* touched_;  // by ActionId
  std::vector<task::SnapId> candidates_;
  std::vector<std::uint8_t> code_;
};

}  // namespace roci::planner::temporal_pddl::search
