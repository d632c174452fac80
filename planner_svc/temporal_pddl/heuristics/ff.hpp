// The FF heuristic (Hoffmann and Nebel 2001) on the relaxed task: a relaxed plan made of the supporters that
// take the fewest actions by h_add, after Stellar section 4.2; its cost are the durations (R16).
// Numbers count by how often an operator has to be applied (beyond R15).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/bucket_queue.hpp"
#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_numbers.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl {

class FfHeuristic final : public Heuristic {
 public:
  // measure: what Estimate::cost counts.
  explicit FfHeuristic(const Task& task, CostMeasure measure = CostMeasure::duration);

  // The state is extended by r_a of the running actions (R19). Ends of actions that run or that the relaxed
  // plan starts belong to the relaxed plan (R20), with what they need. A dead end: a goal or the end of a
  // running action is out of reach, or what it takes can no longer happen in time (EarliestTimes).
  void evaluate(const Situation& situation, Estimate& estimate) override;

  const RelaxedTask& relaxed() const { return relaxed_; }
  // Of the state evaluated last, which is no dead end.
  std::span<const SnapId> relaxed_plan() const { return plan_; }

  // Why time alone forbids every plan from the task's initial state on, or nothing.
  std::string why_too_late();

 private:
  static constexpr std::int64_t kUnreached = -1;

  void reset();
  // True: so it is cheaper.
  bool reach(PropositionId proposition, std::int64_t cost, SnapId supporter);
  void explore(const Situation& situation);
  void fire(SnapId op, StateView state);
  // All it needs is reached, and it can still happen in time.
  bool possible(SnapId op) const;
  const Goal* cheapest_goal() const;
  void need(PropositionId proposition);
  void include(SnapId op);
  // Comparisons follow the propositions of the relaxed task.
  PropositionId proposition(ComparisonId comparison) const {
    return PropositionId(relaxed_.propositions() + comparison.index());
  }
  std::span<const SnapId> needed_by(PropositionId proposition) const;
  bool holds_now(SnapId op) const;
  void extract();
  void order_plan(std::vector<SnapId>& ordered) const;
  void collect(std::uint32_t timed_done, Estimate& estimate) const;

  const Task& task_;
  RelaxedTask relaxed_;
  RelaxedNumbers numbers_;
  EarliestTimes earliest_;

  // By proposition, for the state at hand. A proposition of the state has no supporter.
  IdVector<PropositionId, std::int64_t> reached_at_;
  IdVector<PropositionId, SnapId> supporter_;
  IdVector<PropositionId, bool> needed_;
  IdVector<ComparisonId, std::int64_t> repeats_;  // of its supporter
  // By operator.
  struct Operator {
    std::int64_t cost = 0;   // actions: its own, and those of the reached needs
    std::uint32_t open = 0;  // needs that are not reached
  };
  IdVector<SnapId, Operator> at_first_, operators_;
  IdVector<SnapId, bool> in_plan_;
  IdVector<SnapId, std::int64_t> times_;  // how often, if it is in the plan

  BucketQueue queue_;
  std::vector<PropositionId> to_support_;
  std::vector<SnapId> plan_;
};

}  // namespace roci::planner::temporal_pddl
