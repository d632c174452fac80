// Why no sequence of actions reaches the goal: what the conditions on the way to it wait for in vain.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Holds what grounding knows when it finds that the goal is out of reach.
struct UnreachableGoal {
  const pddl::Problem& problem;
  const std::vector<lifted::LiftedAction>& actions;
  const lifted::StaticModel& static_model;
  const lifted::Symbols& symbols;
  const instantiation::GroundModel& model;
  const instantiation::Disjunction& goal;  ///< before anything was pruned
  const std::vector<bool>& reached;        ///< by literal index, see simplification/relaxed_pruning.hpp
  temporal::Duration epsilon;
};

/// Throws PlanningFailure (unsolvable). The reason begins with the causes that are found going back from the
/// goal through the actions that would help: a fact that is never true, an action that can never run, a
/// number without a value, and who wants it. It ends with the facts of the goal that are out of reach.
[[noreturn]] void refuse(const UnreachableGoal& unreachable);

}  // namespace roci::planner::temporal_pddl::grounding
