// These are the engines that the planner is shipped with.
#pragma once

#include "planner_svc/engine/table.hpp"

namespace roci::planner {

/// Returns the one table of engines: a new engine is named in engines.cpp and nowhere else.
const engine::Table& engines();

}  // namespace roci::planner
