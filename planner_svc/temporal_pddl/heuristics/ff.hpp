// The FF heuristic (Hoffmann and Nebel 2001) on the relaxed task: a relaxed plan made of the supporters that
// take the fewest actions by h_add, after Stellar section 4.2; where it matters when a plan happens, of those
// that can come first. Its cost are the durations (R16). Numbers count by how often an operator has to be
// applied (beyond R15).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_numbers.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_plan.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/heuristics/supporters.hpp"

namespace roci::planner::temporal_pddl {

class FfHeuristic final : public Heuristic {
 public:
  // measure: what Estimate::cost counts.
  explicit FfHeuristic(const Task& task, CostMeasure measure = CostMeasure::duration);

  // The state is extended by r_a of the running actions (R19). Ends of actions that run or that the relaxed
  // plan starts belong to the relaxed plan (R20), with what they need. A dead end: a goal or the end of a
  // running action is out of reach, or what it takes can no longer happen in time (EarliestTimes).
  void evaluate(const Situation& situation, Estimate& estimate) override;

  // Looks at a situation without asking for its goals: what follows is said of it, until the next call of
  // this or of evaluate(). False: a dead end, as an action that runs can never end.
  bool look_at(const Situation& situation);
  // How many actions it takes to reach the fact; none: it is out of reach.
  std::optional<std::int64_t> distance(FactId fact);
  // A relaxed plan that reaches this alone, and ends what runs; made with care (RelaxedPlan), each step after
  // those that it hangs on, those first that take the most actions. The fact must be within reach.
  void plan_for(FactId fact, std::vector<SnapId>& plan);

  std::size_t bytes() const override {
    return relaxed_.bytes() + numbers_.bytes() + earliest_.bytes() + supporters_.bytes() + plan_.bytes();
  }

  const RelaxedTask& relaxed() const { return relaxed_; }
  // Of the state evaluated last, which is no dead end.
  std::span<const SnapId> relaxed_plan() const { return plan_.operators(); }

  // Why time alone forbids every plan from the task's initial state on, or nothing.
  std::string why_too_late();

 private:
  // Null: any time will do.
  const EarliestTimes* times() const { return earliest_.matters() ? &earliest_ : nullptr; }
  const Goal* cheapest_goal();
  bool holds_now(SnapId op) const;
  void order_plan(std::vector<SnapId>& ordered) const;
  void list_deepest_first(SnapId op, std::vector<SnapId>& ordered);
  void collect(std::uint32_t timed_done, Estimate& estimate) const;

  const Task& task_;
  RelaxedTask relaxed_;
  RelaxedNumbers numbers_;
  EarliestTimes earliest_;
  Supporters supporters_;
  RelaxedPlan plan_;  // at hand
  StateView state_;
  std::span<const ActionId> running_;
  std::vector<SnapId> listed_;  // sorted
};

}  // namespace roci::planner::temporal_pddl
