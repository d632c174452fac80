// How many landmarks are still to come (Richter and Westphal 2010), beside the estimate of the FF heuristic.
//
// Nothing is stored per state: which landmarks a plan has reached follows from its steps.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

namespace roci::planner::temporal_pddl {

class LandmarkCount final : public Heuristic {
 public:
  // The landmarks of the task's initial state. Throws what Watch::poll() throws.
  LandmarkCount(const Task& task, FfHeuristic& ff, const Watch& watch);

  // The FF estimate, and in `landmarks` how many are not reached, or needed once more: goals, and what must
  // hold right before one that is not reached. Preferred is also what reaches one that can be next.
  void evaluate(const Situation& situation, Estimate& estimate) override;

  std::size_t bytes() const override { return ff_.bytes() + of_.bytes() + landmarks_.bytes(); }

  const IdVector<LandmarkId, Landmark>& landmarks() const { return landmarks_; }

 private:
  bool all_reached(const std::vector<LandmarkId>& landmarks) const;
  bool holds(const Landmark& landmark, const Situation& situation) const;
  void follow(const Situation& situation);

  const Task& task_;
  FfHeuristic& ff_;
  IdVector<LandmarkId, Landmark> landmarks_;
  FlatLists<LandmarkId> of_;  // by proposition
  IdVector<LandmarkId, bool> reached_at_first_, reached_;
};

}  // namespace roci::planner::temporal_pddl
