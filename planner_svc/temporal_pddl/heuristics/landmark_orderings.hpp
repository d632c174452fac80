// Landmark orderings say which landmarks come before which, without cycles.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Collects orderings of the given landmarks and never lets them form a cycle.
class LandmarkOrderings {
 public:
  LandmarkOrderings(const task::Task& task, const RelaxedTask& relaxed,
                    const task::IdVector<LandmarkId, Landmark>& landmarks);

  /// Adds an ordering; does nothing if `later` comes before `earlier` already.
  void add(LandmarkId earlier, LandmarkId later);
  /// Adds the reasonable orderings, after all others: among goals, and among what must hold right before
  /// another landmark and what else must come before that, first comes what would undo the other.
  void add_reasonable();
  std::vector<LandmarkId> before(LandmarkId later) const;

 private:
  // Returns whether `held` has to be undone to reach `wanted`.
  bool undone_for(LandmarkId held, LandmarkId wanted) const;
  bool mutex(PropositionId a, PropositionId b) const;
  bool undoes(task::SnapId op, PropositionId held) const;

  const task::Task& task_;
  const RelaxedTask& relaxed_;
  const task::IdVector<LandmarkId, Landmark>& landmarks_;
  std::vector<std::vector<bool>> precedes_;                           // closed under transitivity
  task::IdVector<LandmarkId, std::vector<LandmarkId>> right_before_;  // by landmark
  task::IdVector<task::FactId, std::uint32_t> variable_;  // of the packed state; facts.size(): none
};

}  // namespace roci::planner::temporal_pddl::heuristics
