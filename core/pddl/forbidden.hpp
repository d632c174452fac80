// The language of the planner leaves some things out although the parser reads them (R1, Stellar section
// 2.1).
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Returns one diagnostic, with the action's name, per numeric effect that is
/// - continuous (`#t`),
/// - not linear: a product or quotient of fluents that change (fluents that nothing changes and external
///   functions count as constants), or
/// - dependent on ?duration in an action whose duration no `=` fixes at its start.
///
/// It takes a domain and a problem without findings of check().
std::vector<Diagnostic> forbidden_effects(const Domain& domain, const Problem& problem);

}  // namespace roci::pddl
