// A parsed domain or problem must satisfy more than grammar: names are used with their declared arity and
// types; predicates, functions, modules and actions are declared once; variables are bound once; derived
// predicates are stratified and nobody's effect; external functions are nobody's fluent; ?duration,
// total-time and #t stand where they have a meaning. As IPC files need it, a type or object declared again
// gains supertypes or types, and of two initial values of a fluent the last one counts.
#pragma once

#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Returns all findings in the order of their discovery; there are none if all is well.
std::vector<Diagnostic> check(const Domain& domain);
/// Returns the findings in a problem; the domain must be one without findings.
std::vector<Diagnostic> check(const Problem& problem, const Domain& domain);

/// These parse, settle (settle.hpp) and check in one, and throw ParseError with everything that is wrong. What departs
/// from PDDL and has one reading is read so, and stands in the tree's `warnings`; strict reading refuses it.
Domain load_domain(std::string_view text, std::string_view file,
                   Strictness strictness = Strictness::tolerant);
/// `domain` must come from load_domain().
Problem load_problem(std::string_view text, std::string_view file, const Domain& domain,
                     Strictness strictness = Strictness::tolerant);

}  // namespace roci::pddl
