// When each snap action can happen at the earliest: h_max over time on the relaxed task, with windows.
//
// Facts of the state hold from when the plan so far makes them true; a start waits for all it needs, for the
// variables it touches and for a window that is long enough; an end comes no sooner than the least duration
// after its start. What has no such time can never happen after this plan: its windows will be over. A lower
// bound, so that dead ends are proved.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl {

class EarliestTimes {
 public:
  EarliestTimes(const Task& task, const RelaxedTask& relaxed);

  // Without absolute times, time can block nothing: measuring says no more than reachability.
  bool matters() const { return matters_; }
  void measure(const Situation& situation);
  // After measure(). kNever: not at all.
  Ticks of(SnapId op) const { return op_times_[op]; }
  Ticks of(PropositionId proposition) const { return times_[proposition]; }
  // The operator that brings a proposition about at that time. None: it holds from the beginning.
  SnapId supporter(PropositionId proposition) const { return supporters_[proposition]; }
  std::size_t bytes() const {
    return times_.bytes() + supporters_.bytes() + initially_open_.bytes() + open_.bytes() + ready_.bytes() +
           op_times_.bytes();
  }
  // Of a proposition without a time: which action comes too late for its windows, and by how much. Empty:
  // time is not what blocks it.
  std::string why_never(PropositionId proposition) const;

 private:
  void reach(PropositionId proposition, Ticks time, SnapId by);
  void fire(SnapId op, const Situation& situation);
  // The first time from `ready` on at which windows allow the step.
  Ticks fit(SnapId op, Ticks ready) const;
  std::string lateness(SnapId op) const;

  const Task& task_;
  const RelaxedTask& relaxed_;
  bool matters_;
  IdVector<PropositionId, Ticks> times_;
  IdVector<PropositionId, SnapId> supporters_;
  IdVector<SnapId, std::uint32_t> initially_open_, open_;
  IdVector<SnapId, Ticks> ready_, op_times_;
  std::vector<std::pair<Ticks, PropositionId>> queue_;  // a heap, earliest first
};

}  // namespace roci::planner::temporal_pddl
