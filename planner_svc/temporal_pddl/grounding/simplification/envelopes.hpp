// Envelopes (Halsey, Long and Fox 2004) are actions that hold a fact only while they run; this file finds
// what they are too short for.
//
// If a fact is false at first, only starts of durative actions add it, and the ends of the same actions
// delete it, then whatever needs it for all of its duration lies within one of these actions, as the first
// end takes the fact away. So where some of them cannot last as long, it is given one more invariant: a fact
// of its own that holds while one of those runs that can ("required concurrency" of Cushing et al. 2007, with
// durations). No plan is lost and none is added; but whoever looks at facts alone, as relaxed reachability,
// estimates and landmarks do, no longer takes for a support what is too short to be one.
#pragma once

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Gives the envelopes their new facts, which have predicates of their own. It comes before pruning, which
/// takes out what nothing is long enough for.
void split_envelopes_by_duration(instantiation::GroundModel& model, lifted::Symbols& symbols);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
