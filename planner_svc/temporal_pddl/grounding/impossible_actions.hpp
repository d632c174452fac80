// Some action instances can never run, whatever the state: they go, and are remembered with the reason.
#pragma once

#include <cstddef>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Takes the instances out whose start makes a fact of their own `over all` false. That counts for those
/// that take no time, too: the engine asks for `over all` right after every start.
void drop_self_defeating(instantiation::GroundModel& model);

/// Takes the instances out that are shorter than ε and whose end undoes what their start does or the other way round,
/// which have to stand ε apart (R6). What drop_shorter_than_separation() would find only when the task is built.
/// Returns how many there were.
std::size_t drop_undoing_too_soon(instantiation::GroundModel& model, temporal::Duration epsilon);

/// Takes the instances out whose longest duration is less than what keeps their start and end apart: ε, as
/// one changes what the other needs or changes (R6). `task` was built of the model. Returns how many
/// there were; if there were any, the task is to be built again.
std::size_t drop_shorter_than_separation(instantiation::GroundModel& model, const task::Task& task,
                                         temporal::Duration epsilon);

}  // namespace roci::planner::temporal_pddl::grounding
