// Some action instances can never run, whatever the state: they go, and are remembered with the reason.
#pragma once

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Takes the instances out whose start makes a fact of their own `over all` false; one that takes no time at
/// all has no inside for it to hold in.
void drop_self_defeating(instantiation::GroundModel& model);

/// Takes the instances out whose longest duration is less than what keeps their start and end apart: ε, as
/// one changes what the other needs or changes (R6). `task` was built of the model. Returns whether there
/// were any; the task is then to be built again.
bool drop_shorter_than_separation(instantiation::GroundModel& model, const task::Task& task,
                                  temporal::Duration epsilon);

}  // namespace roci::planner::temporal_pddl::grounding
