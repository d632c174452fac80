// Takes the snap actions of a plan one after the other again, some of them left out.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"
#include "planner_svc/temporal_pddl/search/successor_builder.hpp"
#include "planner_svc/temporal_pddl/search/temporal_check.hpp"

namespace roci::planner::temporal_pddl {

class Replay {
 public:
  Replay(const Task& task, Duration epsilon);
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  // A complete plan that can be scheduled, made of the given steps in their order but for the actions that
  // start at the steps in `dropped` and those that cannot start without them. None: that is no plan.
  std::optional<PlanPrefix> run(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped);

  // Likewise, but what is left need reach no goal; actions may still run at its end.
  std::optional<PlanPrefix> rest(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped);

  TemporalCheck& check() { return check_; }

 private:
  // False: the end of an action that was not left out cannot be taken.
  bool take(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped, Successor& at);

  const Task& task_;
  TemporalCheck check_;
  StateStore store_;
  SuccessorBuilder builder_;
  GoalTest goal_;
};

}  // namespace roci::planner::temporal_pddl
