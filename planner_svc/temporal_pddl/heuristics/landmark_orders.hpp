// Which landmarks come before which, without cycles.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

namespace roci::planner::temporal_pddl {

class LandmarkOrders {
 public:
  LandmarkOrders(const Task& task, const RelaxedTask& relaxed,
                 const IdVector<LandmarkId, Landmark>& landmarks);

  // Does nothing if `later` comes before `earlier` already.
  void add(LandmarkId earlier, LandmarkId later);
  // Among goals, and among what must hold right before another landmark and what else must come before that:
  // first what would undo the other. After all other orderings.
  void add_reasonable();
  std::vector<LandmarkId> before(LandmarkId later) const;

 private:
  // To reach `wanted`, `held` has to be undone.
  bool undone_for(LandmarkId held, LandmarkId wanted) const;
  bool mutex(PropositionId a, PropositionId b) const;
  bool undoes(SnapId op, PropositionId held) const;

  const Task& task_;
  const RelaxedTask& relaxed_;
  const IdVector<LandmarkId, Landmark>& landmarks_;
  std::vector<std::vector<bool>> precedes_;                     // closed under transitivity
  IdVector<LandmarkId, std::vector<LandmarkId>> right_before_;  // by landmark
  IdVector<FactId, std::uint32_t> variable_;                    // of the packed state; facts.size(): none
};

}  // namespace roci::planner::temporal_pddl
