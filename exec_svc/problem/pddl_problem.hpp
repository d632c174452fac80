/// A problem for engines that read PDDL, built as core/pddl's tree.
#pragma once

#include <string>

#include "core/pddl/ast.hpp"
#include "exec_svc/problem/situation.hpp"

namespace roci::exec::problem {

/// Text and objects; the mission has a domain. Objects of finished goals that nothing names are left out, and
/// with them the facts that name them.
Problem write_pddl_problem(const Situation& situation, const std::string& name, Reserves reserves);

/// The same as a tree of all that is known at the origin, whether or not the domain can take all of it.
pddl::Problem pddl_tree(const Situation& situation, Reserves reserves);

}  // namespace roci::exec::problem
