// Can the steps of a plan be scheduled (R25, R31), and when?
//
// Beside the network's constraints, a step may have to lie in one of several windows, and an action as a
// whole in one of several. Whatever satisfies these at given times, also does so at the earlier of the times
// of two schedules, for each step; hence there is a least schedule, found by raising times until nothing is
// violated: a step that has missed a window moves to the next one.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/constraints/orderings.hpp"
#include "planner_svc/temporal_pddl/constraints/stn.hpp"
#include "planner_svc/temporal_pddl/constraints/time_bounds.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl {

class TemporalCheck {
 public:
  TemporalCheck(const Task& task, Duration epsilon);

  // The least time of each step; null if the plan is temporally inconsistent. Valid until the next call.
  const std::vector<Ticks>* earliest(const PlanPrefix& prefix);

  // For each step the window in which it lies in the schedule `times`, bounded by what else there is to come.
  std::vector<TimeWindow> chosen_windows(const PlanPrefix& prefix, const std::vector<Ticks>& times) const;
  // For each step all the time from its first window to its last.
  std::vector<TimeWindow> widest_windows(const PlanPrefix& prefix) const;
  // The greatest time of each step if it must also lie in its window; kNever: unbounded.
  static std::vector<Ticks> latest(const PlanPrefix& prefix, const std::vector<TimeWindow>& windows);

  // The network over the steps alone, without absolute times.
  static Stn network(const PlanPrefix& prefix);

 private:
  // The ends of the running actions as further points. One that deletes an invariant of another running
  // action comes no sooner than that one's, and after what has needed the fact: so what cannot end in time
  // for that is found out at once.
  void look_ahead(const PlanPrefix& prefix);
  bool ends_after(ActionId action, ActionId other) const;
  bool schedule(const PlanPrefix& prefix);
  static void fill(const PlanPrefix& prefix, Stn& network);
  Ticks upper_bound(const PlanPrefix& prefix, std::size_t step) const;
  bool fit_windows(const PlanPrefix& prefix, bool& changed);

  const Task& task_;
  TimeBounds bounds_;
  Orderings orderings_;
  IdVector<ActionId, bool> takes_away_;  // its end deletes what is an invariant of some action
  bool absolute_;
  Stn network_;
  std::vector<StepConstraint> pending_;
  std::vector<Ticks> times_;  // of the steps, and of the ends to come
};

}  // namespace roci::planner::temporal_pddl
