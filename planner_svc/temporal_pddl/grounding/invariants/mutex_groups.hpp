// Mutex groups are invariants: sets of atoms of which at most one holds at any time.
//
// A candidate is a set of predicates, each with some positions fixed by the candidate's key and the others
// free; for each value of the key it names a set of atoms. It is an invariant if every snap action that adds
// one of them takes another one away that it needs (so that the number of true ones never grows), after
// Helmert (2009), section 5, checked on ground snap actions. "Action a is running" counts as an atom too: the
// start of a adds it, and its end needs and deletes it. So the place of a rover and its drives make one group
// (Bernardini and Smith 2011).
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::invariants {

/// Holds a set of atoms and running actions of which at most one holds at any time.
struct MutexGroup {
  std::vector<std::uint32_t> atoms;    ///< ascending
  std::vector<std::uint32_t> running;  ///< indices of GroundModel::actions, ascending
};

/// Finds the groups; `reached` is as prune() returns it, and atoms that cannot hold are left out. Groups of
/// a single member are not reported.
std::vector<MutexGroup> find_mutex_groups(const instantiation::GroundModel& model,
                                          const std::vector<bool>& reached, std::size_t predicates,
                                          std::size_t schemas, call::SearchLimits& limits);

}  // namespace roci::planner::temporal_pddl::grounding::invariants
