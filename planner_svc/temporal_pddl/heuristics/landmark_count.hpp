// The landmark count tells how many landmarks are still to come (Richter and Westphal 2010), beside the
// estimate of the FF heuristic.
//
// Nothing is stored per state: which landmarks a plan has reached follows from its steps.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

namespace roci::planner::temporal_pddl::heuristics {

/// Adds the landmark count to the estimate of `ff`. All that it is given must outlive it.
class LandmarkCount final : public Heuristic {
 public:
  /// Finds the landmarks of the initial state of the task. Throws what SearchLimits::poll() throws.
  LandmarkCount(const task::Task& task, FfHeuristic& ff, const call::SearchLimits& limits);

  /// Gives the FF estimate, and in `landmarks` how many are not reached, or needed once more: goals, and
  /// what must hold right before one that is not reached. What reaches a landmark that can be next is
  /// preferred too.
  void evaluate(const EvaluationContext& context, Estimate& estimate) override;

  std::size_t bytes() const override { return ff_.bytes() + of_.bytes() + landmarks_.bytes(); }

  const task::IdVector<LandmarkId, Landmark>& landmarks() const { return landmarks_; }

 private:
  bool all_reached(const std::vector<LandmarkId>& landmarks) const;
  bool holds(const Landmark& landmark, const EvaluationContext& context) const;
  void follow(const EvaluationContext& context);

  const task::Task& task_;
  FfHeuristic& ff_;
  task::IdVector<LandmarkId, Landmark> landmarks_;
  task::FlatLists<LandmarkId> of_;  // by proposition
  task::IdVector<LandmarkId, bool> reached_at_first_, reached_;
};

}  // namespace roci::planner::temporal_pddl::heuristics
