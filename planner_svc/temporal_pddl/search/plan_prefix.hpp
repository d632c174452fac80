// The prefix of a plan leads to a stored state; it is rebuilt by walking back to the root (R27).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"
#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Describes an action that has started and not ended.
struct Running {
  task::ActionId action;
  std::uint32_t step = 0;  ///< the step of its start
  NodeId before;           ///< the state in which it started
};

/// Holds a plan up to a stored state, with its temporal constraints.
struct PlanPrefix {
  NodeId node;
  std::vector<task::SnapId> steps;
  /// Names for the step of an end the step of its start; for any other the step itself.
  std::vector<std::uint32_t> start_of;
  std::vector<constraints::StepConstraint> constraints;  ///< the constraints between steps
  std::vector<Running> running;                          ///< the running actions in order of their starts
  std::vector<task::ActionId> running_actions;           ///< names the actions of `running`, in its order
  /// No step may be later than this; it is set for complete plans, see GoalTest.
  temporal::Duration deadline = temporal::no_bound;
  temporal::Duration closing_time{0};  ///< `closing_step` may be no earlier than this; set likewise
  std::uint32_t closing_step = 0;
  std::uint32_t timed_done = 0;  ///< counts the timed literals among the steps
};

/// Returns whether the plan has more than kMaxSteps steps together with the ends that what runs still needs (R30).
inline bool is_too_long(const PlanPrefix& prefix) {
  return prefix.steps.size() + prefix.running.size() > constraints::kMaxSteps;
}

/// Refills `prefix`, keeping its memory.
void rebuild(const task::Task& task, const StateStore& store, const constraints::BoundTable& bounds,
             temporal::Duration epsilon, NodeId node, PlanPrefix& prefix);

/// Appends one step without constraints; `before` is the state in which it is taken.
void append_step(const task::Task& task, task::SnapId snap, NodeId before, PlanPrefix& prefix);

}  // namespace roci::planner::temporal_pddl::search
