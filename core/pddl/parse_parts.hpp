// This file is internal to core/pddl: parsing and checking of one text share it, so that all that is wrong with it is
// told at once.
#pragma once

#include <string_view>

#include "core/pddl/ast.hpp"
#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Says in which sections something could not be read: names that no other section declares may stand there.
struct Unread {
  bool types = false;
  bool objects = false;  ///< :constants and :objects
  bool predicates = false;
  bool functions = false;  ///< :functions and :modules
};

/// These read what can be read of a text and tell the rest to the log. They throw ParseError with all that the log has
/// if the text is nothing like a domain or problem.
Domain read_domain(std::string_view text, DiagnosticLog& log, Unread& unread);
Problem read_problem(std::string_view text, DiagnosticLog& log, Unread& unread);

}  // namespace roci::pddl
