// This file puts what remains of an earlier plan in terms of the ground task.
#pragma once

#include <span>
#include <vector>

#include "core/pddl/plan_text.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Returns the snap actions of the steps whose actions the task knows, in order of time, ends before starts.
/// Steps that it does not know are passed over.
std::vector<task::SnapId> ground_remaining_plan(const task::Task& task,
                                                std::span<const pddl::PlanStep> remaining);

}  // namespace roci::planner::temporal_pddl::grounding
