// The goal test tells whether a plan is complete: the goals hold and nothing runs (R12).
//
// Goals must hold after the last start or end of an action; what timed literals do to them later does not
// count. So if one still to come would undo them, the whole plan must be over before; and if one that has
// happened may have made them true, some action must happen no earlier than it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"
#include "planner_svc/temporal_pddl/task/semantics.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Tests plans of one task. All that it is given must outlive it.
class GoalTest {
 public:
  GoalTest(const task::Task& task, TemporalCheck& check, temporal::Duration epsilon);

  /// Returns whether the plan is complete; if so, the deadline and the closing step of the prefix are set.
  bool complete(task::StateView state, PlanPrefix& prefix);
  /// Returns whether a timed literal may undo a goal at all.
  bool has_deadlines() const { return has_deadlines_; }
  /// Returns whether a timed literal may make a goal true; then how late a finished step may be matters too.
  bool has_openings() const { return has_openings_; }
  /// Returns after a search without success the facts of the goals that held in none of the states that were
  /// tested.
  std::vector<std::string> never_held() const;
  /// Tells of them in words. `cut` says that some states were not tested, as they lead nowhere.
  std::string failure_reason(std::size_t states, bool cut) const;

 private:
  void note_held(task::StateView state);
  // Returns by when all steps must have happened, or no_bound if there is no such time.
  temporal::Duration deadline(task::StateView state, std::uint32_t timed_done) const;
  // Returns the time of the last timed literal so far that may have made a goal true.
  temporal::Duration opening(std::uint32_t timed_done) const;
  bool close(PlanPrefix& prefix);

  const task::Task& task_;
  TemporalCheck& check_;
  task::Semantics semantics_;
  temporal::Duration epsilon_;
  bool has_deadlines_ = false;
  bool has_openings_ = false;
  std::vector<bool> opens_;              // by timed step: it may make a goal true
  std::vector<std::vector<bool>> held_;  // by goal alternative and fact
};

}  // namespace roci::planner::temporal_pddl::search
