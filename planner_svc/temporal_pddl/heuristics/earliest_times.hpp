// EarliestTimes finds when each snap action can happen at the earliest: h_max over time on the relaxed task,
// with windows.
//
// Facts of the state hold from when the plan so far makes them true; a start waits for all it needs, for the
// variables it touches and for a window that is long enough; an end comes no sooner than the least duration
// after its start. What has no such time can never happen after this plan: its windows will be over. The
// times are lower bounds, so that dead ends are proved.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Measures earliest times after one plan after the other. All that it is given must outlive it.
class EarliestTimes {
 public:
  EarliestTimes(const task::Task& task, const RelaxedTask& relaxed);

  /// Returns whether time can block anything. Without absolute times it cannot, and measuring says no more
  /// than reachability.
  bool matters() const { return matters_; }
  void measure(const EvaluationContext& context);
  /// Returns the earliest time after measure(), or no_bound for what can never happen or hold.
  temporal::Duration of(task::SnapId op) const { return op_times_[op]; }
  temporal::Duration of(PropositionId proposition) const { return times_[proposition]; }
  /// Returns the operator that brings the proposition about at that time, or none if it holds from the
  /// beginning.
  task::SnapId supporter(PropositionId proposition) const { return supporters_[proposition]; }
  std::size_t bytes() const {
    return times_.bytes() + supporters_.bytes() + initially_open_.bytes() + open_.bytes() + ready_.bytes() +
           op_times_.bytes();
  }
  /// Tells of a proposition without a time which action comes too late for its windows, and by how much; the
  /// text is empty if time is not what blocks it.
  std::string lateness_reason(PropositionId proposition) const;

 private:
  void reach(PropositionId proposition, temporal::Duration time, task::SnapId by);
  void fire(task::SnapId op, const EvaluationContext& context);
  // Returns the first time from `ready` on at which windows allow the step.
  temporal::Duration fit(task::SnapId op, temporal::Duration ready) const;
  std::string lateness_of(task::SnapId op) const;

  const task::Task& task_;
  const RelaxedTask& relaxed_;
  bool matters_;
  task::IdVector<PropositionId, temporal::Duration> times_;
  task::IdVector<PropositionId, task::SnapId> supporters_;
  task::IdVector<task::SnapId, std::uint32_t> initially_open_, open_;
  task::IdVector<task::SnapId, temporal::Duration> ready_, op_times_;
  std::vector<std::pair<temporal::Duration, PropositionId>> queue_;  // a heap, earliest first
};

}  // namespace roci::planner::temporal_pddl::heuristics
