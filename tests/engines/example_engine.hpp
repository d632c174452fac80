// The engine of planner_svc/README.md.
#pragma once

#include "planner_svc/engine/table.hpp"

namespace roci::planner::proof {

const engine::Table& example_engines();

}  // namespace roci::planner::proof
