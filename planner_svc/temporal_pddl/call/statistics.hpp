// What a planning call counts of its own work.
#pragma once

#include <cstddef>

namespace roci::planner::temporal_pddl::call {

/// The counters of one planning call. Searches keep them up to date all the time, so that a caller may watch
/// them (Monitor::progress).
struct Statistics {
  std::size_t facts = 0;                    ///< ground facts of the task
  std::size_t variables = 0;                ///< finite-domain variables of the packed state
  std::size_t numeric_variables = 0;        ///< numeric state variables
  std::size_t actions = 0;                  ///< ground actions
  std::size_t generated = 0;                ///< successors that were put into an open list
  std::size_t evaluated = 0;                ///< heuristic evaluations
  std::size_t for_first_plan = 0;           ///< of these, until there was a plan; all where there is none
  std::size_t expanded = 0;                 ///< states whose successors were generated
  std::size_t temporally_inconsistent = 0;  ///< successors that the temporal network pruned (R25)
  std::size_t dominated = 0;                ///< successors that the dominance check pruned
  std::size_t dead_ends = 0;                ///< successors that a dead-end detector pruned
  /// The mean over the stored states, in bytes: packed state, numbers, parent, operator, constraints.
  double bytes_per_state = 0;
  bool exhausted = false;  ///< whether the search for better plans came to its end, so that there is none
  bool from_remaining = false;        ///< whether the first plan was made of what remained of an earlier one
  std::size_t function_requests = 0;  ///< batches that owners of external functions were asked for
  std::size_t exact_values = 0;       ///< tuples in them that were to be exact
  std::size_t cheap_values = 0;       ///< tuples in them for which less was asked
  std::size_t rounds = 1;             ///< searches, each on values that were known better
  std::size_t peak_bytes = 0;         ///< the largest amount of memory, as the engine counts its own
};

}  // namespace roci::planner::temporal_pddl::call
