// The temporal PDDL engine: forward search over snap actions with a Simple Temporal Network per state, after
// Stellar (Coles et al. 2019, sections 2 and 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "core/pddl/ast.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/function_source.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

// How much a call may cost. The engine has no clock: `out_of_time` knows the deadline; it is polled like
// Monitor::cancelled.
struct Budget {
  std::size_t evaluations =
      std::numeric_limits<std::size_t>::max();  // heuristic evaluations: work, machine-independent
  std::size_t memory_bytes = std::numeric_limits<std::size_t>::max();
  std::function<bool()> out_of_time;  // empty: never
};

// `progress` gets the statistics so far now and then (about every thousand expansions). `cancelled` is polled
// at least about every millisecond of work; so it must be cheap. Either may be empty.
struct Monitor {
  std::function<void(const Statistics&)> progress;
  std::function<bool()> cancelled;
};

// remaining: what is left of an earlier plan; if it can be completed at little cost, that is the first plan.
// Deterministic: equal arguments (and answers of `functions`) give equal results, unless time or cancellation
// ended the call. Never throws for what stands in the model: that is a verdict with a reason.
Result plan(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
            const Budget& budget, const Monitor& monitor, const Options& options = {},
            std::span<const pddl::PlanStep> remaining = {});

}  // namespace roci::planner::temporal_pddl
