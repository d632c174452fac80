// The states that a search has stored, and how it gets from one to the next: what every search over plans
// shares, whatever its order of expansion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/successor_tree.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl {

class StateSpace {
 public:
  StateSpace(const Task& task, Duration epsilon, ActionSteps steps)
      : task_(task),
        steps_(steps),
        epsilon_(epsilon),
        store_(task.layout.words()),
        check_(task, epsilon),
        builder_(task, store_, check_, epsilon, steps),
        tree_(task) {}
  StateSpace(const StateSpace&) = delete;
  StateSpace& operator=(const StateSpace&) = delete;

  // The plan to a stored state.
  void restore(NodeId node, PlanPrefix& prefix) const {
    rebuild(task_, store_, bounds_, epsilon_, node, prefix);
  }
  // The snap actions that are applicable after the plan to a stored state: first the ends of what runs, then
  // starts and plain actions, then the next timed literal. Valid until the next call.
  std::span<const SnapId> applicable(const PlanPrefix& prefix);
  // Is it worth a try after the plan to a stored state?
  bool possible(const PlanPrefix& prefix, SnapId snap) const { return builder_.applicable(prefix, snap); }
  Rejection build(const PlanPrefix& prefix, SnapId snap, Successor& successor) {
    return builder_.build(prefix, snap, successor);
  }
  // Stores the successor of `parent` (none: the initial state) and names its node in its prefix.
  NodeId add(NodeId parent, Successor& successor);

  // Forgets all states.
  void clear() { store_.clear(); }

  ActionSteps steps() const { return steps_; }
  const StateStore& store() const { return store_; }
  const BoundTable& bounds() const { return bounds_; }
  TemporalCheck& check() { return check_; }

 private:
  const Task& task_;
  ActionSteps steps_;
  Duration epsilon_;
  StateStore store_;
  BoundTable bounds_;
  TemporalCheck check_;
  SuccessorBuilder builder_;
  SuccessorTree tree_;
  std::vector<SnapId> candidates_;
  std::vector<std::uint8_t> code_;
};

}  // namespace roci::planner::temporal_pddl
