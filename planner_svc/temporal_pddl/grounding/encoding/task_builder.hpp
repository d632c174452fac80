// The task builder turns the ground model into the task's flat tables; facts and numbers get their final ids.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/compression_safety.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::grounding::encoding {

/// Builds the task; `compression` stands by action. Facts that no group covers get a variable each.
task::Task build_task(const instantiation::GroundModel& model, const lifted::Symbols& symbols,
                      const std::vector<lifted::LiftedAction>& schemas,
                      const std::vector<invariants::MutexGroup>& groups,
                      const std::vector<invariants::Compression>& compression, call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::grounding::encoding
