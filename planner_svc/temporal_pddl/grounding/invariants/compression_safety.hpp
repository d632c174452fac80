// Compression safety (R14) says which actions may be ended in the search as soon as they have started.
//
// Ending a right after its start, instead of after some other snap actions B that the plan has in between,
// must lose no plan. The criterion sharpens Coles et al. (AIJ 2009, "Managing concurrency in temporal
// planning using planner-scheduler interaction"), who ask that the end needs nothing beyond the invariants
// and only adds facts: the orderings R22 and R23 follow the order of the steps, so an early end must not push
// any step of B behind itself.
//
// A variable is isolated from a if no step of B can touch it: no other action ever does (and a does not run
// beside itself), or every snap action that has it in a condition or an effect needs a fact that is mutex
// with "a is running", and no action with an invariant on it can run beside a.
//
// a is compression safe if
//  1. each fact at its end is an invariant of a that is never added while it is true (deleted while it is
//     false, if negated), or is isolated; what its end only reads is isolated;
//  2. each number in its invariants and end conditions is isolated, and no duration is measured at the end;
//  3. each fact that its end changes
//     - is isolated, or
//     - is only ever added, and only goals ask for it (such facts have no orderings at all), or
//     - is only ever added, never asked for negated, all its other adders need a fact that is mutex with
//       "a is running", and it is false before a starts (to be tested then) and a's start does not add it:
//       so it is false while a runs and B cannot need it;
//  4. each number that its end changes is isolated.
// Steps of B then find the same values and get no orderings behind the end that they had not before.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"

namespace roci::planner::temporal_pddl::grounding::invariants {

/// Says whether an action is compression safe, and under what condition.
struct Compression {
  bool safe = false;
  task::ShortList<std::uint32_t> absent;  ///< the atoms that must be false before the start
};

/// Finds compression safety for each action, after prune() and drop_irrelevant_effects().
std::vector<Compression> find_compression(const instantiation::GroundModel& model,
                                          const std::vector<MutexGroup>& groups, call::SearchLimits& limits);

/// Returns for each atom whether it is only ever added and in no condition of an action. Orderings on it
/// would say nothing.
std::vector<bool> only_goals_ask(const instantiation::GroundModel& model);

}  // namespace roci::planner::temporal_pddl::grounding::invariants
