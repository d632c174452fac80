// Some action instances can never run, whatever the state: they go, and are remembered with the reason.
#pragma once

#include <cstddef>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Takes the instances out whose start makes a fact of their own `over all` false. That counts for those
/// that take no time, too: the engine asks for `over all` right after every start.
void drop_self_defeating(instantiation::GroundModel& model);

/// Takes the instances out whose longest duration is less than what keeps their start and end apart: ε, as
/// one changes what the other needs or changes (R6). `task` was built of the model. Returns how many
/// there were; if there were any, the task is to be built again.
std::size_t drop_shorter_than_separation(instantiation::GroundModel& model, const task::Task& task,
                                         temporal::Duration epsilon);

}  // namespace roci::planner::temporal_pddl::grounding
