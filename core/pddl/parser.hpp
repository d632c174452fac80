// The parser turns PDDL text into a syntax tree. It accepts the language of ast.hpp; it refuses object
// fluents, preferences, trajectory constraints, processes and events by name. Nesting is limited (kMaxNesting
// in sexpr.hpp), so no input can exhaust the stack.
#pragma once

#include <string_view>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// These throw ParseError at the first thing that is not PDDL; names, types and arities are left to
/// check.hpp. `file` is used in messages only.
Domain parse_domain(std::string_view text, std::string_view file);
Problem parse_problem(std::string_view text, std::string_view file);

}  // namespace roci::pddl
