// The diagnosis of a search that tried everything in vain says which numbers stood in the way.
#pragma once

#include <string>

#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::search {

/// Returns a text as "(drill r) needs (battery) >= 30: never more than 20". It names a comparison of the
/// goal, or of an action towards a goal that holds in no stored state, which holds in none of them. It is
/// empty if numbers are not to blame.
std::string unmet_comparison(const task::Task& task, const StateStore& store);

}  // namespace roci::planner::temporal_pddl::search
