// Lookahead (Vidal 2004): follows the relaxed plan of a state as far as it goes, and so takes many steps for
// the cost of one evaluation.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::search {

/// Follows relaxed plans in one state space. All that it is given must outlive it.
class Lookahead {
 public:
  Lookahead(const task::Task& task, StateSpace& space)
      : task_(task), space_(space), uses_(task.fact_names.size(), 0) {}

  /// Takes from the plan `from`, whose node is stored, what of the relaxed plan can be taken, in its order
  /// and again as long as anything can; ends and timed literals come only where no start can. Where nothing can, the
  /// next timed literals and values are taken if a start can follow them, which was too early for its conditions or
  /// too late for a number that it reads. Every state on the way is stored, and the last one is put in `last`, which
  /// is not `from`'s own. If `careful`, what undoes a fact that holds and that another action still to be taken needs,
  /// and keeps, waits until nothing else can be taken; so whoever leaves a place has done what was to be done there.
  /// Returns false if nothing can be taken.
  bool follow(const PlanPrefix& from, std::span<const task::SnapId> relaxed_plan, bool careful,
              Successor& last);

 private:
  bool waits(task::SnapId snap) const;
  bool take_starts(Successor& last);
  bool take_one_harmful_start(Successor& last);
  bool take_one_that_waits(Successor& last);
  bool take_start_after_timed_steps(Successor& last);
  bool take_start(task::SnapId start, Successor& last);
  bool take(task::SnapId snap, Successor& last);
  const task::Action& action_of(task::SnapId start) const { return task_.actions[task_.snaps[start].action]; }
  bool has_to_wait(task::SnapId start, const PlanPrefix& prefix) const;
  void count_uses(task::SnapId start, int by);

  const task::Task& task_;
  StateSpace& space_;
  bool careful_ = true;
  Successor before_timed_;
  std::size_t failures_left_ = 0;               // steps tried in vain, each as costly as one taken
  std::vector<task::SnapId> starts_, waiting_;  // still to be taken
  task::IdVector<task::FactId, int> uses_;      // how many of starts_ need the fact and do not undo it
};

}  // namespace roci::planner::temporal_pddl::search
