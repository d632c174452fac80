// The switches of the engine with their defaults. Every combination gives valid plans and the same verdicts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/temporal/duration.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::temporal_pddl::call {

/// Which timed initial literals become bounds on the steps that need them; the others are steps of the search
/// (R32).
enum class WindowExtraction {
  none,       ///< every timed literal is a step
  one_off,    ///< facts that are true during one interval become windows (R33)
  recurring,  ///< so do facts that come and go several times, see grounding/simplification/timed_windows.hpp
};

/// How one planning call searches.
struct Options {
  temporal::Duration epsilon{1000};  ///< the separation of interfering time points (R6, Z4)
  bool compression_safety = true;    ///< R14, see grounding/invariants/compression_safety.hpp
  bool dominance = true;             ///< see search/dominance.hpp; off: R26 to the letter
  bool preferred_operators = true;   ///< R21
  bool landmarks = true;  ///< see heuristics/landmarks.hpp; landmarks take no effect without dominance
  bool compress_all_actions = true;  ///< see task/action_compression.hpp and search/portfolio.hpp
  bool novelty = true;               ///< see search/novelty.hpp; novelty takes no effect without dominance
  bool lookahead = true;             ///< see search/lookahead.hpp
  bool best_first_width = true;      ///< see search/best_first_width_search.hpp; needs dominance
  bool goal_serialization = true;    ///< see search/goal_serialization.hpp
  WindowExtraction windows = WindowExtraction::recurring;
  /// How many states are asked about before it is measured what resources suffice for, see
  /// dead_ends/resource_dead_ends.hpp.
  std::size_t resource_patience = 100;
  /// How many evaluations pass before h² mutexes are looked for, see dead_ends/mutex_dead_ends.hpp.
  std::size_t pair_patience = 100;
  /// How many evaluations are spent after the first plan in search of better ones; with 0, only useless
  /// actions are taken out.
  std::size_t improvement_evaluations = 0;
  std::uint64_t seed = 0;  ///< breaks ties among equally good successors; 0 keeps the order of generation
  engine::FunctionsMode functions =
      engine::FunctionsMode::eager;  ///< see planner_svc/temporal_pddl/refining.hpp
  bool describe_activities = true;   ///< whether activities carry conditions and effects, for an executive
};

}  // namespace roci::planner::temporal_pddl::call
