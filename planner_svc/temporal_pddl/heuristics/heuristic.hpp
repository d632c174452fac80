// A heuristic tells a search about a state. README.md says how to add one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/release_times.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Holds what a heuristic says of one state.
struct Estimate {
  bool dead_end = false;  ///< whether it is proved that no plan goes through this state
  /// Sums the durations still to come, in microseconds, or what else CostMeasure counts.
  std::int64_t cost = 0;
  std::int64_t steps = 0;      ///< the snap actions still to come, and penalties for goals that they threaten
  std::int64_t landmarks = 0;  ///< the landmarks that are still to come
  /// Names what is applicable in the state and useful, as far as the heuristic sees (R21).
  std::vector<task::SnapId> preferred;
  /// Names the steps that would reach the goals if nothing stood in the way, by when they can be taken, each
  /// as often as it takes.
  std::vector<task::SnapId> relaxed_plan;
};

/// Holds what a heuristic may look at.
struct EvaluationContext {
  task::StateView state;
  std::span<const task::ActionId> running;  ///< the actions that have started and not ended
  std::uint32_t timed_done = 0;             ///< counts the timed literals that have happened
  /// Tells the schedule of earliest times of the plan; it is null, and `started` is empty, where nothing is
  /// known of it.
  const constraints::ReleaseTimes* release_times = nullptr;
  std::span<const temporal::Duration> started;  ///< the start times, by position in `running`
  std::span<const task::SnapId> steps = {};     ///< the steps of the plan so far
};

/// Defines the interface of all heuristics; none of them changes what it looks at.
class Heuristic {
 public:
  virtual ~Heuristic() = default;

  /// Fills in the estimate, whose memory is reused.
  virtual void evaluate(const EvaluationContext& context, Estimate& estimate) = 0;
  /// Returns how many bytes it keeps that grow with the problem, those of what it builds upon included.
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace roci::planner::temporal_pddl::heuristics
