// Relaxed reachability finds which atoms and action instances can appear at all if nothing is ever deleted
// and numbers that change are ignored.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"

namespace roci::planner::temporal_pddl::grounding::reachability {

/// Holds what relaxed reachability has found.
struct Reachability {
  lifted::TupleTable atoms;   ///< has also some that are only read
  std::vector<bool> reached;  ///< is indexed by atom
  /// Holds the instances of each action, as the objects of its parameters. Their starts are reachable and
  /// nothing static speaks against them; whether their ends are reachable is left to prune().
  task::IdVector<task::SchemaId, task::FlatLists<task::ObjectId>> instances;
};

/// Explores the model from its initial atoms and timed literals. Throws what SearchLimits throws.
Reachability explore(const std::vector<lifted::LiftedAction>& actions,
                     const lifted::StaticModel& static_model, call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::grounding::reachability
