// Relaxed reachability: which atoms and action instances can appear at all if nothing is ever deleted and
// numbers that change are ignored.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/tuple_table.hpp"
#include "planner_svc/temporal_pddl/grounding/world.hpp"
#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

struct Reachability {
  TupleTable atoms;           // also some that are only mentioned
  std::vector<bool> reached;  // by atom
  // The instances of each action, as the objects of its parameters. Their starts are reachable and nothing
  // static speaks against them; whether their ends are reachable is left to prune().
  IdVector<SchemaId, FlatLists<ObjectId>> instances;
};

Reachability explore(const std::vector<LiftedAction>& actions, const World& world, Watch& watch);

}  // namespace roci::planner::temporal_pddl
