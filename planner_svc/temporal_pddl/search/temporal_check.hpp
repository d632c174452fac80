// The temporal check tells whether the steps of a plan can be scheduled (R25, R31), and when.
//
// Beside the constraints of the network, a step may have to lie in one of several windows, and an action as a
// whole in one of several. Whatever satisfies these at given times, also does so at the earlier of the times
// of two schedules, for each step; hence there is a least schedule, found by raising times until nothing is
// violated: a step that has missed a window moves to the next one.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/constraints/longest_path_stn.hpp"
#include "planner_svc/temporal_pddl/constraints/orderings.hpp"
#include "planner_svc/temporal_pddl/constraints/step_deadlines.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl::search {

/// Checks one plan after the other and keeps its memory in between. The task must outlive it.
class TemporalCheck {
 public:
  TemporalCheck(const task::Task& task, temporal::Duration epsilon);

  /// Returns the least time of each step, or null if the plan is temporally inconsistent. The times are
  /// valid until the next call.
  const std::vector<temporal::Duration>* earliest(const PlanPrefix& prefix);

  /// Returns for each step the window in which it lies in the schedule `times`, bounded by what else there
  /// is to come.
  std::vector<task::TimeWindow> chosen_windows(const PlanPrefix& prefix,
                                               const std::vector<temporal::Duration>& times) const;
  /// Returns for each step all the time from its first window to its last.
  std::vector<task::TimeWindow> widest_windows(const PlanPrefix& prefix) const;
  /// Returns the greatest time of each step if it must also lie in its window, or no_bound.
  static std::vector<temporal::Duration> latest(const PlanPrefix& prefix,
                                                const std::vector<task::TimeWindow>& windows);

  /// Returns the network over the steps alone, without absolute times.
  static constraints::LongestPathStn network(const PlanPrefix& prefix);

 private:
  // Adds the ends of the running actions as further points. One that deletes an invariant of another running
  // action comes no sooner than that one's, and after what has needed the fact: so what cannot end in time
  // for that is found out at once.
  void look_ahead(const PlanPrefix& prefix);
  bool ends_after(task::ActionId action, task::ActionId other) const;
  bool schedule(const PlanPrefix& prefix);
  static void fill(const PlanPrefix& prefix, constraints::LongestPathStn& network);
  temporal::Duration upper_bound(const PlanPrefix& prefix, std::size_t step) const;
  bool fit_windows(const PlanPrefix& prefix, bool& changed);

  const task::Task& task_;
  constraints::StepDeadlines bounds_;
  constraints::Orderings orderings_;
  task::IdVector<task::ActionId, bool> takes_away_;  // its end deletes what is an invariant of some action
  bool absolute_;
  constraints::LongestPathStn network_;
  std::vector<constraints::StepConstraint> pending_;
  std::vector<temporal::Duration> times_;  // of the steps, and of the ends to come
};

}  // namespace roci::planner::temporal_pddl::search
