// This file drops effects that nothing can notice.
#pragma once

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Drops effects on atoms that no condition and no goal reads, unless some effects add and others delete
/// them (those may not coincide, whoever reads them), and effects on numbers from which no condition,
/// duration or goal follows.
void drop_irrelevant_effects(instantiation::GroundModel& model);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
