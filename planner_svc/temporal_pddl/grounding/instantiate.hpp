// From reachable instances to ground actions.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability.hpp"
#include "planner_svc/temporal_pddl/grounding/world.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// An instance with disjunctive conditions becomes one ground action per combination of alternatives (an `over
// all` disjunction thereby asks for one alternative during the whole action), one with conditional effects
// one per choice of those that happen. Throws Refusal as FormulaGrounder does, and for more than
// kMaxAlternatives combinations. Takes the atoms out of `reachability`.
GroundModel instantiate(const pddl::Domain& domain, const pddl::Problem& problem,
                        const std::vector<LiftedAction>& actions, const World& world,
                        Reachability reachability, Watch& watch);

}  // namespace roci::planner::temporal_pddl
