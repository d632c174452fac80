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
  Replay(const Task& task, Duration epsilon) : task_(task), epsilon_(epsilon), check_(task, epsilon) {}

  // A complete plan that can be scheduled, made of the given steps in their order but for the actions that
  // start at the steps in `dropped` and those that cannot start without them. None: that is no plan.
  std::optional<PlanPrefix> run(std::span<const SnapId> steps, std::span<const std::uint32_t> dropped);

  TemporalCheck& check() { return check_; }

 private:
  const Task& task_;
  Duration epsilon_;
  TemporalCheck check_;
};

}  // namespace roci::planner::temporal_pddl
