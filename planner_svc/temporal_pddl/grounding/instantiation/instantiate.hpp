// Instantiation goes from reachable instances to ground actions.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/reachability.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

/// Instantiates the model. An instance with disjunctive conditions becomes one ground action per combination
/// of alternatives (an `over all` disjunction thereby asks for one alternative during the whole action), one
/// with conditional effects one per choice of those that happen. Throws ModelFailure as FormulaGrounder
/// does, and for more than kMaxAlternatives combinations. Takes the atoms out of `reachability`.
GroundModel instantiate(const pddl::Domain& domain, const pddl::Problem& problem,
                        const std::vector<lifted::LiftedAction>& actions,
                        const lifted::StaticModel& static_model, reachability::Reachability reachability,
                        call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
