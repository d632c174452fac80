// Facts that only timed initial literals touch and that are true during one interval (R33, Tierney et al.
// 2012).
#pragma once

#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"

namespace roci::planner::temporal_pddl {

// Replaces conditions on such facts by bounds on the times of the snap actions, and the timed literals by
// nothing: a condition at a point must hold ε after the fact appears and until ε before it goes, one over all
// may touch both. Facts that are negated somewhere or asked for by the goal stay as they are, and so do
// recurring windows. Actions that fit into no window are removed.
void extract_one_off_windows(GroundModel& model, Duration epsilon);

}  // namespace roci::planner::temporal_pddl
