/// How many variables a part of a domain or a goal binds: parameters and those of all quantifiers. Planner and
/// executive choose an object for each.
#pragma once

#include <cstddef>

#include "core/pddl/ast.hpp"

namespace roci::exec::mission {

/// More are refused when the mission is read, as planner_svc's temporal_pddl refuses them.
inline constexpr std::size_t kMostVariables = 256;

std::size_t variable_count(const pddl::Condition& condition);

/// Throws pddl::ParseError with each action and derived predicate that has more than kMostVariables, and its place.
void require_few_variables(const pddl::Domain& domain);

}  // namespace roci::exec::mission
