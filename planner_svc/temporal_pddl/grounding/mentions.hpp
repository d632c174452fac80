// Facts and numbers that conditions mention without asking for them (Mention).
#pragma once

#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"

namespace roci::planner::temporal_pddl {

// Puts what derived facts hang on in their place, and drops what no effect changes. After prune().
void settle_mentions(GroundModel& model);

}  // namespace roci::planner::temporal_pddl
