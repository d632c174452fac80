// Cuts off what resources do not suffice for (ResourceNeed), around any heuristic.
//
// Most problems are solved before the measuring pays: it waits until a number of states have been asked
// about, and a resource has run half empty in one of them. A search that never gets there has no want of any.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/resource_need.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

class WithinResources final : public Heuristic {
 public:
  // patience: how many states may be asked about before it measures; 0: it measures with the first, whatever
  // is left.
  WithinResources(const Task& task, Heuristic& heuristic, std::size_t patience, Watch& watch);

  void evaluate(const Situation& situation, Estimate& estimate) override {
    heuristic_.evaluate(situation, estimate);
  }
  bool hopeless(StateView state, std::span<const ActionId> running, ActionSteps steps) override;
  std::size_t bytes() const override;

  // Why resources alone forbid every plan from the task's initial state on, or nothing.
  std::string why_too_little();

 private:
  struct Measured {
    const Resource* resource;
    ResourceNeed need;
  };

  bool runs_short(StateView state) const;
  void measure();
  void measure(const Resource& resource, std::span<const FactId> goals);

  const Task& task_;
  Heuristic& heuristic_;
  std::size_t patience_;
  bool short_;  // of some resource, in some state
  Watch& watch_;
  std::vector<Resource> resources_;
  bool measured_ = false;
  std::size_t work_ = 0;  // of all measuring so far
  std::vector<Measured> needs_;
};

}  // namespace roci::planner::temporal_pddl
