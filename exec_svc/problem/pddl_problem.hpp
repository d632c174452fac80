/// A problem for engines that read PDDL, built as core/pddl's tree.
#pragma once

#include <string>

#include "exec_svc/problem/situation.hpp"

namespace roci::exec::problem {

/// Text and objects; the mission has a domain. Objects of finished goals that nothing names are left out, and
/// with them the facts that name them.
Problem write_pddl_problem(const Situation& situation, const std::string& name, Reserves reserves);

}  // namespace roci::exec::problem
