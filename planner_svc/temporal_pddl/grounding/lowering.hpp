// From the syntax tree to lifted actions.
#pragma once

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted.hpp"
#include "planner_svc/temporal_pddl/grounding/symbols.hpp"

namespace roci::planner::temporal_pddl {

// The domain's actions in their order: plain ones, then durative ones; then the rules of derived predicates,
// by layer. Throws Refusal (unsupported) for conditional effects that look at `over all` or, in a start
// effect, at the end.
std::vector<LiftedAction> lower_actions(const pddl::Domain& domain, const Symbols& symbols);

// The duration in it is the plan's: (total-time).
LiftedExpression lower_metric(const pddl::Expression& metric, const std::string& file,
                              const Symbols& symbols);

// A formula without free variables; `slots` grows by those of its quantifiers.
LiftedFormula lower_goal(const pddl::Condition& goal, const std::string& file, const Symbols& symbols,
                         std::uint32_t& slots);

}  // namespace roci::planner::temporal_pddl
