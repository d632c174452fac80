// Switches of the engine with their defaults. Every combination gives valid plans and the same verdicts.
#pragma once

#include <cstdint>

#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

// Which timed initial literals become bounds on the steps that need them; the others are steps of the search
// (R32).
enum class WindowExtraction {
  none,
  one_off,    // facts that are true during one interval (R33)
  recurring,  // also those that come and go several times, see grounding/timed_windows.hpp
};

struct Options {
  Duration epsilon{1000};           // separation of interfering time points (R6, Z4)
  bool compression_safety = true;   // R14, see task/compression.hpp
  bool dominance = true;            // see search/dominance.hpp; off: R26 to the letter
  bool preferred_operators = true;  // R21
  bool landmarks = true;            // see heuristics/landmarks.hpp; takes no effect without dominance
  bool whole_actions = true;        // see search/search.hpp
  bool novelty = true;              // see search/novelty.hpp; takes no effect without dominance
  bool lookahead = true;            // see search/lookahead.hpp
  bool width = true;                // see search/width_search.hpp; takes no effect without dominance
  bool serial = true;               // see search/serial_search.hpp
  WindowExtraction windows = WindowExtraction::recurring;
  std::size_t resource_patience = 100;  // states before it is measured what resources suffice for, see
                                        // dead_ends/within_resources.hpp
  std::size_t pair_patience = 100;      // evaluations before the pairs of facts from which the goals are out
                                        // of reach are looked for, see dead_ends/avoids_dead_pairs.hpp
  std::size_t improvement_evaluations = 0;  // after the first plan, in search of better ones; 0: only useless
                                            // actions go
  std::uint64_t seed = 0;           // breaks ties among equally good successors; 0: in order of generation
  bool describe_activities = true;  // a plan's activities carry conditions and effects, for an executive
};

}  // namespace roci::planner::temporal_pddl
