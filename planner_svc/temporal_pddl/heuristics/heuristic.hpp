// What a heuristic tells the search about a state. See README.md for how to add one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/time_freedom.hpp"
#include "planner_svc/temporal_pddl/task/action_steps.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

struct Estimate {
  bool dead_end = false;             // proved: no plan goes through this state
  std::int64_t cost = 0;             // microseconds of the actions still to come, one after the other
  std::int64_t steps = 0;            // snap actions still to come, and a price on goals that they undo
  std::int64_t landmarks = 0;        // still to come
  std::vector<SnapId> preferred;     // applicable in the state and useful, as far as the heuristic sees (R21)
  std::vector<SnapId> relaxed_plan;  // steps that would reach the goals if nothing stood in the way, by when
                                     // they can be taken; each as often as it takes
};

// What a heuristic may look at.
struct Situation {
  StateView state;
  std::span<const ActionId> running;  // actions that have started and not ended
  std::uint32_t timed_done = 0;       // how many timed literals have happened
  // The plan's schedule of earliest times; null and empty where nothing is known of it.
  const TimeFreedom* freedom = nullptr;
  std::span<const Ticks> started;      // by position in `running`
  std::span<const SnapId> steps = {};  // the plan so far
};

class Heuristic {
 public:
  virtual ~Heuristic() = default;

  // The estimate's memory is reused.
  virtual void evaluate(const Situation& situation, Estimate& estimate) = 0;
  // Proved at little cost that no plan goes through the state? Asked before anything is stored or evaluated.
  virtual bool hopeless(StateView /*state*/, std::span<const ActionId> /*running*/, ActionSteps /*steps*/) {
    return false;
  }
  // What it keeps that grows with the problem, that of what it builds upon included.
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace roci::planner::temporal_pddl
