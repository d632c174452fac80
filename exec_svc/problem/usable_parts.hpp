/// What of a PDDL problem the domain can take. One observation of something that no problem declares, or one goal with
/// a word that is none of the domain's, would make the whole problem invalid, and with it every plan.
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

/// What one goal adds to the goal of the problem.
struct GoalPart {
  goals::GoalKey key;
  std::vector<pddl::Condition> facts;
};

/// Removes from `tree` the facts, values and timed literals that make it invalid by themselves, and names them in
/// `out.left_out`; names in `out.unusable_goals` the goals that do so, which stay in `tree`. The objects are taken as
/// they are: where they alone make it invalid, nothing is changed. A problem that is valid is looked at once.
void keep_usable_parts(pddl::Problem& tree, const std::vector<GoalPart>& goals, const pddl::Domain& domain,
                       Problem& out);

}  // namespace roci::exec::problem
