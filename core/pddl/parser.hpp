// The parser turns PDDL text into a syntax tree. It accepts the language of ast.hpp; it refuses object
// fluents, preferences, trajectory constraints, processes and events by name. Nesting is limited (kMaxNesting
// in sexpr.hpp), so no input can exhaust the stack.
#pragma once

#include <string_view>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// These throw ParseError with everything in the text that is not PDDL; names, types and arities are left to
/// check.hpp. What departs from PDDL and has one reading is read so, and stands in the tree's `warnings`; strict
/// reading refuses it. `file` is used in messages only.
Domain parse_domain(std::string_view text, std::string_view file,
                    Strictness strictness = Strictness::tolerant);
Problem parse_problem(std::string_view text, std::string_view file,
                      Strictness strictness = Strictness::tolerant);

}  // namespace roci::pddl
