// This detector proves dead ends that consumable resources do not suffice for (ConsumptionBound).
//
// Most problems are solved before the measuring pays: it waits until a number of states have been asked
// about, and a resource has run half empty in one of them. A search that never gets there has no want of any.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/call/search_limits.hpp"
#include "planner_svc/temporal_pddl/dead_ends/consumption_bound.hpp"
#include "planner_svc/temporal_pddl/dead_ends/dead_end_detector.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Never takes a state with a plan for a dead end (it is safe). The task and the limits must outlive it.
class ResourceDeadEnds final : public DeadEndDetector {
 public:
  /// Waits until `patience` states have been asked about before it measures; with 0 it measures with the
  /// first, whatever is left.
  ResourceDeadEnds(const task::Task& task, std::size_t patience, call::SearchLimits& limits);

  bool proves_dead_end(task::StateView state, std::span<const task::ActionId> running,
                       task::ActionCompression compression) override;
  std::size_t bytes() const override;

  /// Tells why resources alone forbid every plan from the initial state of the task on; the text is empty if
  /// they do not.
  std::string shortage_reason();

 private:
  struct Measured {
    const task::ConsumableResource* resource;
    ConsumptionBound need;
  };

  bool runs_short(task::StateView state) const;
  void measure();
  void measure(const task::ConsumableResource& resource, std::span<const task::FactId> goals);

  const task::Task& task_;
  std::size_t patience_;
  bool short_;  // of some resource, in some state
  call::SearchLimits& limits_;
  std::vector<task::ConsumableResource> resources_;
  bool measured_ = false;
  std::size_t work_ = 0;  // of all measuring so far
  std::vector<Measured> needs_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
