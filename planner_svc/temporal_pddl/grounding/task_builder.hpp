// From the ground model to the task's flat tables: facts and numbers get their final ids.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/grounding/compression.hpp"
#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/mutex_groups.hpp"
#include "planner_svc/temporal_pddl/grounding/symbols.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// `compression` by action. Facts that no group covers get a variable each.
Task build_task(const GroundModel& model, const Symbols& symbols, const std::vector<LiftedAction>& schemas,
                const std::vector<MutexGroup>& groups, const std::vector<Compression>& compression,
                Watch& watch);

}  // namespace roci::planner::temporal_pddl
