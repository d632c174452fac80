// Read sets hold the facts and numbers that conditions read without asking for them (ReadVariable).
#pragma once

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Puts what derived facts hang on in their place, and drops what no effect changes. It comes after prune().
void settle_read_sets(instantiation::GroundModel& model);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
