// This file builds a problem for engines that read PDDL as core/pddl's tree.
#pragma once

#include <string>

#include "core/pddl/ast.hpp"
#include "exec_svc/problem/situation.hpp"

namespace roci::exec::problem {

/// Writes text and objects of the problem; the mission must have a domain. Objects of finished goals that
/// nothing names are left out, together with the facts that name them.
Problem write_pddl_problem(const Situation& situation, const std::string& name, Reserves reserves);

/// Builds the tree of all that is known at the origin, including what the domain cannot take.
pddl::Problem pddl_tree(const Situation& situation, Reserves reserves);

}  // namespace roci::exec::problem
