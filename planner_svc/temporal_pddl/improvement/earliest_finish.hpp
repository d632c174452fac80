// How soon all can be over: a relaxed plan in which whatever makes a fact true first makes it true, given
// when the plan so far leaves things free, put into a schedule.
//
// The FF heuristic asks for few actions and so always sends the nearest; this one sends who is free.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl {

class EarliestFinish {
 public:
  explicit EarliestFinish(const Task& task);

  // The situation must tell its freedom and what has started when. No bound in either direction: deletes and
  // numbers do not count, but two actions that change the same variable come one after the other. kNever: a
  // goal is out of reach.
  Ticks measure(const Situation& situation);
  // After measure(): the steps of the relaxed plan of which all facts hold, and how many steps it has.
  std::span<const SnapId> preferred() const { return preferred_; }
  std::size_t steps() const { return plan_.size(); }
  // All its steps in the order of that schedule, timed literals and derivations among them.
  std::span<const SnapId> plan() const { return plan_; }
  // What could be reached only later than this does not count as reachable.
  void limit(Ticks time) { limit_ = time; }

 private:
  struct Fact {
    Ticks time = kNever;
    SnapId by;  // none: it holds
  };
  struct Operator {
    Ticks ready = 0;
    std::uint32_t open = 0;  // needs that are not reached
  };

  void reach(PropositionId proposition, Ticks time, SnapId by);
  void fire(SnapId op, const TimeFreedom& freedom);
  Ticks fit(SnapId op, Ticks ready) const;
  void explore(const Situation& situation);
  bool settled(const Goal& goal, Ticks now) const;
  const Goal* soonest_goal() const;
  void need(PropositionId proposition);
  void include(SnapId op);
  void find_preferred();
  Ticks schedule();
  Ticks place(SnapId op);

  const Task& task_;
  RelaxedTask relaxed_;

  IdVector<PropositionId, Fact> facts_;
  IdVector<SnapId, Operator> at_first_, operators_;
  std::vector<std::pair<Ticks, PropositionId>> queue_;  // a heap, earliest first
  IdVector<PropositionId, bool> needed_;
  IdVector<SnapId, bool> in_plan_;
  std::vector<PropositionId> to_support_;
  std::vector<SnapId> plan_, preferred_;
  IdVector<SnapId, Ticks> times_;  // when each can happen; in the relaxed plan, when it does
  std::vector<Ticks> free_from_;   // by variable of the state
  Ticks limit_ = kNever;
  std::vector<std::size_t> occupied_;  // those that are not free from the start
};

}  // namespace roci::planner::temporal_pddl
