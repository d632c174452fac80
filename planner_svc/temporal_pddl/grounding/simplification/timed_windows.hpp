// Facts that only timed initial literals touch become windows of the snap actions that need them.
//
// Stellar (section 4.4, R33; Tierney et al. 2012) does so for facts that are true during one interval. The
// same works for recurring windows: that a step lies in one of several intervals, or a whole action in one of
// them, is a constraint whose solutions are closed under taking earlier times, so that the least schedule is
// still found by propagation alone and the search need not choose a window (see search/temporal_check.hpp).
#pragma once

#include "planner_svc/temporal_pddl/call/options.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Replaces conditions on such facts by bounds on the times of the snap actions, and the timed literals by
/// nothing: a condition at a point must hold ε after the fact appears and until ε before it goes, one over
/// all may touch both. Facts that are negated or only read somewhere or asked for by the goal stay as they
/// are. Actions that fit into no window are removed.
void extract_timed_windows(instantiation::GroundModel& model, call::WindowExtraction mode,
                           temporal::Duration epsilon);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
