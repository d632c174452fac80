// This is the FF heuristic (Hoffmann and Nebel 2001) on the relaxed task, after Stellar section 4.2.
//
// Its relaxed plan is made of the supporters that take the fewest actions by h_add; where it matters when a
// plan happens, of those that can come first. Its cost is the sum of the durations (R16). Numbers count by
// how often an operator has to be applied (beyond R15).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/call/named_goal.hpp"
#include "planner_svc/temporal_pddl/heuristics/best_supporters.hpp"
#include "planner_svc/temporal_pddl/heuristics/earliest_times.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/heuristics/numeric_relaxation.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_plan.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Estimates what is still to come by a relaxed plan. The task must outlive it.
class FfHeuristic final : public Heuristic {
 public:
  /// Estimates the task; `measure` is what Estimate::cost counts.
  explicit FfHeuristic(const task::Task& task, CostMeasure measure = CostMeasure::duration);

  /// Extends the state by r_a of the running actions (R19). Ends of actions that run or that the relaxed
  /// plan starts belong to the relaxed plan (R20), with what they need. The state is a dead end if a goal or
  /// the end of a running action is out of reach, or if what it takes can no longer happen in time
  /// (EarliestTimes).
  void evaluate(const EvaluationContext& context, Estimate& estimate) override;

  /// Looks at a state without asking for its goals; what follows is said of it until the next call of this
  /// or of evaluate(). Returns false for a dead end, where an action that runs can never end.
  bool look_at(const EvaluationContext& context);
  /// Returns how many actions it takes to reach the fact, or nothing if it is out of reach.
  std::optional<std::int64_t> distance(task::FactId fact);
  /// Fills in a relaxed plan that reaches this fact alone and ends what runs. It is made with care
  /// (RelaxedPlan): each step comes after those that it hangs on, and those first that take the most
  /// actions. The fact must be within reach.
  void plan_for(task::FactId fact, std::vector<task::SnapId>& plan);

  std::size_t bytes() const override {
    return relaxed_.bytes() + numbers_.bytes() + earliest_.bytes() + supporters_.bytes() + plan_.bytes();
  }

  const RelaxedTask& relaxed() const { return relaxed_; }
  /// Returns the relaxed plan of the state evaluated last, which is no dead end.
  std::span<const task::SnapId> relaxed_plan() const { return plan_.operators(); }

  /// Returns the fact of the goals that time alone puts out of reach from the initial state of the task on,
  /// and why; nothing if time does not.
  std::optional<call::BlockedFact> lateness();

 private:
  // Is null where any time will do.
  const EarliestTimes* times() const { return earliest_.matters() ? &earliest_ : nullptr; }
  const task::Goal* cheapest_goal();
  bool holds_now(task::SnapId op) const;
  void order_plan(std::vector<task::SnapId>& ordered) const;
  void list_deepest_first(task::SnapId last, std::vector<task::SnapId>& ordered);
  void collect(std::uint32_t timed_done, Estimate& estimate) const;

  const task::Task& task_;
  RelaxedTask relaxed_;
  NumericRelaxation numbers_;
  EarliestTimes earliest_;
  BestSupporters supporters_;
  RelaxedPlan plan_;  // at hand
  task::StateView state_;
  std::span<const task::ActionId> running_;
  std::vector<task::SnapId> listed_;  // sorted
};

}  // namespace roci::planner::temporal_pddl::heuristics
