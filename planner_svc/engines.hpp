// The engines that the planner is shipped with.
#pragma once

#include "planner_svc/engine/table.hpp"

namespace roci::planner {

/// The one table of engines: whoever adds one names it in engines.cpp and nowhere else.
const engine::Table& engines();

}  // namespace roci::planner
