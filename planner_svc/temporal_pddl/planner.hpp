// The temporal PDDL engine: forward search over snap actions with a Simple Temporal Network per state, after
// Stellar (Coles et al. 2019, sections 2 and 4).
#pragma once

#include <span>

#include "core/pddl/ast.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/result.hpp"

namespace roci::planner::temporal_pddl {

/// Plans, and never throws for what stands in the model: that is a verdict with a reason. The call is
/// deterministic: equal arguments (and answers of `functions`) give equal results, unless time or
/// cancellation ended it. `remaining` is what is left of an earlier plan; if it can be completed at little
/// cost, that is the first plan.
Result plan(const pddl::Domain& domain, const pddl::Problem& problem, engine::FunctionSource& functions,
            const call::Budget& budget, const call::Monitor& monitor, const call::Options& options = {},
            std::span<const pddl::PlanStep> remaining = {});

}  // namespace roci::planner::temporal_pddl
