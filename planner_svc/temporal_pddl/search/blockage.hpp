// Which numbers stood in the way of a search that tried everything.
#pragma once

#include <string>

#include "planner_svc/temporal_pddl/search/state_store.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

// "(drill r) needs (battery) >= 30: never more than 20": of a goal, or of an action towards a goal that holds
// in no stored state, a comparison that holds in none of them. Empty if numbers are not to blame.
std::string blocking_number(const Task& task, const StateStore& store);

}  // namespace roci::planner::temporal_pddl
