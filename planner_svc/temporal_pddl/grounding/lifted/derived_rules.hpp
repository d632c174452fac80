// This file turns derived predicates into rules of a form that instantiation takes, split where they say
// "or".
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Wherever the precondition of `rule` holds, its one effect, the derived atom, is true.
struct DerivedRule {
  pddl::Action rule;
  int layer = 0;  ///< see core/pddl/stratify.hpp
};

/// Returns the rules by layer. An alternative of a body becomes a rule of its own, and what exists is a
/// parameter: joins find instances, and no disjunction grows. Throws ModelFailure (unsupported) for a body
/// with too many combinations of alternatives (rules of 250,000 conditions together).
std::vector<DerivedRule> derived_rules(const pddl::Domain& domain);

}  // namespace roci::planner::temporal_pddl::grounding::lifted
