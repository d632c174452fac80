// A mission file names actions, types, predicates and fluents of its PDDL domain. They must exist there, so
// that a misspelt name is found when the mission is read and not when the first plan is wanted.
#pragma once

#include <string>

#include "core/mission/entry.hpp"
#include "core/pddl/ast.hpp"

namespace roci::exec::mission {

/// Parses the text of a domain. Throws roci::mission::FileError with the place in `file` and the remedy.
pddl::Domain read_domain(const std::string& text, const std::string& file);

/// Throws roci::mission::FileError at the first name in mission.yaml (`root`) that the domain does not know,
/// or with another number of arguments; and when an action of the domain has no command.
void require_domain_names(const roci::mission::Entry& root, const pddl::Domain& domain);

}  // namespace roci::exec::mission
