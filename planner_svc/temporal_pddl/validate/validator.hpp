// The validator answers whether a plan solves a problem. It follows PDDL 2.2 (Fox and Long 2003; Edelkamp and
// Hoffmann 2004) by executing the plan, happening by happening, on the syntax tree itself. It shares nothing
// with the planner but core/pddl.
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"
#include "core/pddl/function_table.hpp"
#include "core/pddl/plan_text.hpp"
#include "planner_svc/temporal_pddl/validate/report.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Holds the tolerances of a validation, in microseconds.
struct Options {
  /// Happenings that interfere must be at least this far apart (Z4).
  pddl::Microseconds epsilon{1000};
  /// Durations in plans are rounded; an `=` within the tolerance counts as met, and ?duration then has its
  /// exact value.
  pddl::Microseconds duration_tolerance{500};
};

/// Returns a valid report exactly if the plan solves the problem, and every violation else.
/// - Happenings of one moment see the state before it; they may not interfere with one another, nor with
///   others (timed facts included) less than epsilon away.
/// - Over-all conditions hold in every state between start and end, not at the two ends themselves.
/// - Goals hold after the last happening of the plan; later timed facts do not count.
/// - A condition on an undefined number or an unreachable external function does not hold.
///
/// It takes a domain and a problem without findings of check(), in which forbidden_effects() finds no
/// continuous effect. Its cost grows with the plan and with the objects that its quantifiers range over;
/// nothing is grounded.
Report validate(const pddl::Domain& domain, const pddl::Problem& problem,
                const std::vector<pddl::PlanStep>& plan, const pddl::FunctionTable& functions,
                const Options& options = {});

}  // namespace roci::planner::temporal_pddl::validate
