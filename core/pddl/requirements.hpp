// Requirement flags of PDDL say what a domain or problem needs (PDDL 2.1, appendix A.1; PDDL 2.2 for derived
// predicates and timed literals).
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Returns the flags that are needed and neither stand in :requirements nor follow from one that does (:adl,
/// :quantified-preconditions, :fluents, …), with the first place that needs them. Inequality of objects needs :equality
/// alone, :action-costs is enough for numbers, and :modules is needed by nothing: only this tree knows it.
std::map<std::string, SourceLocation> lacking_requirements(const Domain& domain);
/// Does so for a problem, for which the flags of its domain hold as well.
std::map<std::string, SourceLocation> lacking_requirements(const Problem& problem, const Domain& domain);

}  // namespace roci::pddl
