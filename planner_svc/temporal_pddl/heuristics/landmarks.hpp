// Landmarks are what every plan must make true at some time, with the order in which it must (Hoffmann,
// Porteous and Sebastia 2004; Richter and Westphal 2010).
//
// A landmark is a fact, "a is running", or one of a few of them. They are found on the relaxed task by
// leaving them out and seeing what is out of reach then: the goals (so it is a landmark), other landmarks
// (which come later), and which operators add it first (what these have in common comes right before).
// Reasonable orderings are added: A comes before B if B would have to be undone for A.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/heuristics/relaxed_task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using LandmarkId = task::Id<struct LandmarkTag>;

/// Describes one landmark with its place among the others.
struct Landmark {
  std::vector<PropositionId> any_of;    ///< one of these must hold
  bool goal = false;                    ///< whether it must hold at the end
  bool initially = false;               ///< whether it holds in the initial state
  std::vector<LandmarkId> after;        ///< the landmarks that come before it with none in between
  std::vector<LandmarkId> needed_by;    ///< the landmarks right before whose first time it holds
  std::vector<task::SnapId> achievers;  ///< its first achievers; for the end of an action, the start
};

/// Finds the landmarks. `relaxed_plan` names operators that reach a goal from the initial state; each
/// landmark is among what they need. The work is bounded by `max_visits` of operators, after which some
/// landmarks may be left out. Throws what SearchLimits::poll() throws.
task::IdVector<LandmarkId, Landmark> find_landmarks(const task::Task& task, const RelaxedTask& relaxed,
                                                    std::span<const task::SnapId> relaxed_plan,
                                                    std::size_t max_visits, const call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::heuristics
