// Drops effects that nothing can notice.
#pragma once

#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"

namespace roci::planner::temporal_pddl {

// Effects on atoms that no condition and no goal reads or mentions go, unless some effects add and others
// delete them (those may not coincide, whoever reads them), and so do effects on numbers from which no
// condition, duration or goal follows.
void drop_irrelevant_effects(GroundModel& model);

}  // namespace roci::planner::temporal_pddl
