// The causes that keep a goal out of reach, found going back from it.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/unreachable_goal.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Returns a few texts, nearest to the goal first: a fact that is never true, an action that can never run, a number
/// without a value, and who wants it. There may be none.
std::vector<std::string> causes_of(const UnreachableGoal& unreachable);

/// Appends the parts of a conjunction, those of conjunctions in it among them; another condition is its own part.
void collect_parts(const pddl::Condition& condition, std::vector<const pddl::Condition*>& parts);

}  // namespace roci::planner::temporal_pddl::grounding
