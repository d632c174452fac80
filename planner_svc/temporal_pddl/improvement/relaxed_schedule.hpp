// A relaxed schedule is a relaxed plan that is put into a schedule: it tells how soon all can be over.
//
// Whatever makes a fact true first makes it true in this plan, given when the plan so far leaves things free.
// The FF heuristic asks for few actions and so always sends the nearest; this one sends who is free.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Measures one state after the other. The task must outlive it.
class RelaxedSchedule {
 public:
  explicit RelaxedSchedule(const task::Task& task);

  /// Returns when all can be over, or no_bound if a goal is out of reach. The context must tell its release
  /// times and what has started when. The time is no bound in either direction: deletes and numbers do not
  /// count, but two actions that change the same variable come one after the other.
  temporal::Duration measure(const heuristics::EvaluationContext& context);
  /// Returns, after measure(), the steps of the relaxed plan of which all facts hold.
  std::span<const task::SnapId> preferred() const { return preferred_; }
  std::size_t steps() const { return plan_.size(); }
  /// Returns how many bytes it keeps that grow with the problem.
  std::size_t bytes() const {
    return relaxed_.bytes() + facts_.bytes() + at_first_.bytes() + operators_.bytes() + needed_.bytes() +
           in_plan_.bytes() + times_.bytes();
  }
  /// Returns all its steps in the order of that schedule, timed literals and derivations among them.
  std::span<const task::SnapId> plan() const { return plan_; }
  /// Lets what could be reached only later than this not count as reachable.
  void limit(temporal::Duration time) { limit_ = time; }

 private:
  struct Fact {
    temporal::Duration time = temporal::no_bound;
    task::SnapId by;  // none: it holds
  };
  struct Operator {
    temporal::Duration ready{0};
    std::uint32_t open = 0;  // needs that are not reached
  };

  void reach(heuristics::PropositionId proposition, temporal::Duration time, task::SnapId by);
  void fire(task::SnapId op, const constraints::ReleaseTimes& release_times);
  temporal::Duration fit(task::SnapId op, temporal::Duration ready) const;
  void explore(const heuristics::EvaluationContext& context);
  bool settled(const task::Goal& goal, temporal::Duration now) const;
  const task::Goal* soonest_goal() const;
  void need(heuristics::PropositionId proposition);
  void include(task::SnapId op);
  void find_preferred();
  temporal::Duration schedule();
  temporal::Duration place(task::SnapId op);

  const task::Task& task_;
  heuristics::RelaxedTask relaxed_;

  task::IdVector<heuristics::PropositionId, Fact> facts_;
  task::IdVector<task::SnapId, Operator> at_first_, operators_;
  std::vector<std::pair<temporal::Duration, heuristics::PropositionId>> queue_;  // a heap, earliest first
  task::IdVector<heuristics::PropositionId, bool> needed_;
  task::IdVector<task::SnapId, bool> in_plan_;
  std::vector<heuristics::PropositionId> to_support_;
  std::vector<task::SnapId> plan_, preferred_;
  // Holds when each step can happen; in the relaxed plan, when it does.
  task::IdVector<task::SnapId, temporal::Duration> times_;
  std::vector<temporal::Duration> free_from_;  // by variable of the state
  temporal::Duration limit_ = temporal::no_bound;
  std::vector<std::size_t> occupied_;  // those that are not free from the start
};

}  // namespace roci::planner::temporal_pddl::improvement
