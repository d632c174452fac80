// PDDL text to syntax tree. Accepts the language of ast.hpp; refuses object fluents, preferences, trajectory
// constraints, processes and events by name. Nesting is limited (kMaxNesting in sexpr.hpp), so no input can
// exhaust the stack.
#pragma once

#include <string_view>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// `file` is used in messages only. Throw ParseError at the first thing that is not PDDL; names, types and
/// arities are left to check.hpp.
Domain parse_domain(std::string_view text, std::string_view file);
Problem parse_problem(std::string_view text, std::string_view file);

}  // namespace roci::pddl
