// This file keeps the parts of a PDDL problem that the domain can take. One observation of something undeclared, or
// one goal with a word unknown to the domain, would make the whole problem invalid, and with it every plan.
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

/// Holds what one goal adds to the goal of the problem.
struct GoalPart {
  goals::GoalKey key;
  std::vector<pddl::Condition> facts;
};

/// Removes from `tree` the facts, values and timed literals that make it invalid by themselves, and names them in
/// `out.left_out`; names in `out.unusable_goals` the goals that do so, which stay in `tree`. Objects stay as they
/// are: where they alone make it invalid, nothing is changed. A valid problem is checked once.
void keep_usable_parts(pddl::Problem& tree, const std::vector<GoalPart>& goals, const pddl::Domain& domain,
                       Problem& out);

}  // namespace roci::exec::problem
