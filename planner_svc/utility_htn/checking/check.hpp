// The independent checker of a plan version (R74, R81, R87, R110–R112, R126): it computes everything anew by brute
// force, and sees only the network and how it is read, not the timeline library, the search or the Downlink Manager, so
// that a mistake there cannot hide itself.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/utility_htn/checking/question.hpp"

namespace roci::planner::utility_htn::checking {

/// Returns all faults, each as one plain sentence; none if the plan may be flown. The network is checked already.
///
/// Checked are: blocks (each a decomposition of its request, in order, with its gaps; no request twice, none that is
/// closed); times (commit window, fixed starts, windows of tasks, end of the plan); commitments of the version before;
/// preconditions, maintenance and postconditions of each step and the conditions of the decomposition; ranges of all
/// timelines from the end of the commit window on; the budget; the downlinks; the subway map. A conflict that what is
/// committed has by itself is not the plan's fault.
std::vector<std::string> faults(const Question& question);

}  // namespace roci::planner::utility_htn::checking
