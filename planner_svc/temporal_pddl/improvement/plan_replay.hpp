// A replay takes the snap actions of a plan one after the other again, some of them left out.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Replays plans of one task, which must outlive it.
class PlanReplay {
 public:
  PlanReplay(const task::Task& task, temporal::Duration epsilon);
  PlanReplay(const PlanReplay&) = delete;
  PlanReplay& operator=(const PlanReplay&) = delete;

  /// Returns a complete plan that can be scheduled, made of the given steps in their order but for the
  /// actions that start at the steps in `dropped` and those that cannot start without them; or nothing if
  /// that is no plan.
  std::optional<search::PlanPrefix> run(std::span<const task::SnapId> steps,
                                        std::span<const std::uint32_t> dropped);

  /// Does likewise, but what is left need reach no goal; actions may still run at its end.
  std::optional<search::PlanPrefix> rest(std::span<const task::SnapId> steps,
                                         std::span<const std::uint32_t> dropped);

  search::TemporalCheck& check() { return check_; }

 private:
  // Returns false if the end of an action that was not left out cannot be taken.
  bool take(std::span<const task::SnapId> steps, std::span<const std::uint32_t> dropped,
            search::Successor& at);

  const task::Task& task_;
  search::TemporalCheck check_;
  search::StateStore store_;
  search::SuccessorBuilder builder_;
  search::GoalTest goal_;
};

}  // namespace roci::planner::temporal_pddl::improvement
