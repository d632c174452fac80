// The remaining plan is what is left of a plan when a new one is asked for. The planner begins with it, so
// that little changes where little has happened, and its first plan costs next to nothing.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// Holds an action as the planner wrote it, before it was bound to a command.
struct PlannedAction {
  std::string activity;  ///< its id in the bound plan
  std::string name;
  std::vector<std::string> arguments;
  temporal::Duration start{0};  ///< from the plan's origin, in the schedule of earliest times
  temporal::Duration duration{0};
  friend bool operator==(const PlannedAction&, const PlannedAction&) = default;
};

/// Returns the actions of a plan as it came from the planner, without ids.
std::vector<PlannedAction> planned_actions(const temporal::FlexiblePlan& plan);

/// Leaves out actions that run, have succeeded or were skipped; one that no step mentions stays.
std::vector<PlannedAction> remaining_actions(std::vector<PlannedAction> planned,
                                             const std::vector<executive::StepStatus>& steps);

}  // namespace roci::exec::reactor
