// A quantifier may bind a variable that is bound around it; checks and planner know each variable by one name.
#pragma once

#include "core/pddl/ast.hpp"
#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Renames each variable that hides an outer one, ?x to ?x', in its quantifier and all that
/// this binds, and warns of it.
void rename_hiding_variables(Domain& domain, DiagnosticLog& log);
void rename_hiding_variables(Problem& problem, DiagnosticLog& log);

}  // namespace roci::pddl
