// Settling gives a tree that departs from PDDL its one reading, so that checks and planner meet PDDL alone.
#pragma once

#include "core/pddl/ast.hpp"
#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Passes over a type under itself and predicates and functions that are declared again alike, and warns of these, of
/// types and constants that are declared twice, and of requirements that are used without their flag. Renames variables
/// that hide outer ones (hidden_variables.hpp), as the other function does.
void settle(Domain& domain, DiagnosticLog& log);

/// Takes objects of undeclared types as plain objects, passes over initial values of undeclared functions and over
/// another name of the domain, and warns of these, of objects that are declared twice, and of requirements that the
/// problem needs and neither file has a flag for. `domain` must be settled.
void settle(Problem& problem, const Domain& domain, DiagnosticLog& log);

}  // namespace roci::pddl
