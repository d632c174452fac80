// Lowering turns the syntax tree into lifted actions.
#pragma once

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Returns the actions of the domain in their order, first plain ones, then durative ones, and then the rules
/// of derived predicates by layer. Throws ModelFailure (unsupported) for conditional effects that look at
/// `over all` or, in a start effect, at the end, and for more than kMaxSlots variables.
std::vector<LiftedAction> lower_actions(const pddl::Domain& domain, const Symbols& symbols);

/// Returns the metric, in which the duration stands for (total-time).
LiftedExpression lower_metric(const pddl::Expression& metric, const std::string& file,
                              const Symbols& symbols);

/// Returns a formula without free variables; `slots` grows by those of its quantifiers. Throws as above for
/// too many of them.
LiftedFormula lower_goal(const pddl::Condition& goal, const std::string& file, const Symbols& symbols,
                         std::uint32_t& slots);

}  // namespace roci::planner::temporal_pddl::grounding::lifted
