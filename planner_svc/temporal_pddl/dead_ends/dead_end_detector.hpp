// Detectors prove, state by state, that no plan goes through a state; they stand in a list beside the
// heuristics.
//
// A detector is safe: it never calls a state a dead end from which the goals can be reached ("safe" as of
// heuristics that detect dead ends, Hoffmann, Kissmann and Torralba 2014). Its cost per state is small; what
// tables it needs, it makes when enough states have been seen that they pay.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/action_compression.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Defines the interface of a safe detector.
class DeadEndDetector {
 public:
  virtual ~DeadEndDetector() = default;

  /// Returns true only if no plan goes through the state in which these actions run. Searches ask before they
  /// store or evaluate a state. `compression` is how the asking search takes actions. Throws what
  /// SearchLimits throws.
  virtual bool proves_dead_end(task::StateView state, std::span<const task::ActionId> running,
                               task::ActionCompression compression) = 0;
  /// Takes in each heuristic evaluation, so that it can wait with its tables until they pay.
  virtual void note_evaluation() {}
  /// Returns how many bytes it keeps that grow with the problem.
  virtual std::size_t bytes() const = 0;
};

/// Asks the detectors of a planning call one after the other. An empty list proves nothing.
class DeadEndDetectors {
 public:
  /// Appends a detector, which must outlive the list.
  void add(DeadEndDetector& detector) { detectors_.push_back(&detector); }

  bool prove_dead_end(task::StateView state, std::span<const task::ActionId> running,
                      task::ActionCompression compression) {
    return std::ranges::any_of(detectors_, [&](DeadEndDetector* detector) {
      return detector->proves_dead_end(state, running, compression);
    });
  }
  void note_evaluation() {
    for (DeadEndDetector* detector : detectors_) detector->note_evaluation();
  }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const DeadEndDetector* detector : detectors_) sum += detector->bytes();
    return sum;
  }

 private:
  std::vector<DeadEndDetector*> detectors_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
