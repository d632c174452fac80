// The plan that leads to a stored state, rebuilt by walking back to the root (R27).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"
#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// An action that has started and not ended.
struct Running {
  ActionId action;
  std::uint32_t step = 0;  // of its start
  NodeId before;           // the state in which it started
};

struct PlanPrefix {
  NodeId node;
  std::vector<SnapId> steps;
  std::vector<std::uint32_t> start_of;      // by step: of an end, the step of its start; else the step itself
  std::vector<StepConstraint> constraints;  // between steps
  std::vector<Running> running;             // in order of their starts
  std::vector<ActionId> running_actions;    // the same
  Ticks deadline = kNever;                  // no step may be later; set for complete plans, see GoalTest
  Ticks closing_time = 0;                   // likewise: `closing_step` may be no earlier
  std::uint32_t closing_step = 0;
  std::uint32_t timed_done = 0;  // timed literals among the steps
};

// Refills `prefix`, keeping its memory.
void rebuild(const Task& task, const StateStore& store, const BoundTable& bounds, Duration epsilon,
             NodeId node, PlanPrefix& prefix);

// Appends one step without constraints. before: the state in which it is taken.
void append_step(const Task& task, SnapId snap, NodeId before, PlanPrefix& prefix);

}  // namespace roci::planner::temporal_pddl
