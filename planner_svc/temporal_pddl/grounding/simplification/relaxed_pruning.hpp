// This file prunes the ground model by relaxed reachability, ends and negative conditions included.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Returns the number of a literal: 2 · atom + (negated ? 1 : 0).
inline std::size_t literal_index(instantiation::GroundLiteral literal) {
  return 2 * std::size_t{literal.atom} + literal.negated;
}

/// Removes the actions that can never start or never end, the rules that never derive anything, the
/// conditions that always hold, and goal alternatives that are out of reach. A condition at a time point
/// stays if some effect brings about what holds anyway: the two must not coincide (R6). Returns by literal
/// index what can hold.
std::vector<bool> prune(instantiation::GroundModel& model, call::SearchLimits& limits);

/// Returns the conditions of the start snap action: at_start, and what of over_all the start itself cannot
/// bring about.
std::vector<instantiation::GroundLiteral> start_requirements(const instantiation::GroundModel& model,
                                                             const instantiation::GroundAction& action);

}  // namespace roci::planner::temporal_pddl::grounding::simplification
