// The table of the proof engines: with their folders, all that is added for them.
#pragma once

#include "planner_svc/engine/table.hpp"

namespace roci::planner::proof {

// "search" answers calls, "chain" plans all the time.
const engine::Table& engines();

}  // namespace roci::planner::proof
