// Landmarks: what every plan must make true at some time, and in which order.
//
// Facts, "a is running", or one of a few of them, found on the relaxed task by leaving them out and seeing
// what is out of reach then: the goals (a landmark), other landmarks (which come later), and which operators
// add it first (what these have in common comes right before). Reasonable orderings are added: A before B if
// B would have to be undone for A (Hoffmann, Porteous and Sebastia 2004; Richter and Westphal 2010).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

using LandmarkId = Id<struct LandmarkTag>;

struct Landmark {
  std::vector<PropositionId> any_of;  // one of them
  bool goal = false;                  // must hold at the end
  bool initially = false;             // holds in the initial state
  std::vector<LandmarkId> after;      // these come before
  std::vector<LandmarkId> needed_by;  // it holds right before each of these does for the first time
  std::vector<SnapId> achievers;      // first ones; of an action's end, its start
};

// relaxed_plan: operators that reach a goal from the initial state; each landmark is among what they need.
// The work is bounded by `max_visits` of operators, after which some landmarks may be left out. Throws what
// Watch::poll() throws.
IdVector<LandmarkId, Landmark> find_landmarks(const Task& task, const RelaxedTask& relaxed,
                                              std::span<const SnapId> relaxed_plan, std::size_t max_visits,
                                              const Watch& watch);

}  // namespace roci::planner::temporal_pddl
