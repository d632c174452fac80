// Cuts off states with a pair of literals from which the goals are out of reach (DeadPairs), around any
// heuristic.
//
// Most problems are solved before the tables pay: they are made after a number of evaluations, for the kind
// of search that asks, and given up where they take too much work or memory.
#pragma once

#include <array>
#include <optional>

#include "planner_svc/temporal_pddl/dead_ends/dead_pairs.hpp"
#include "planner_svc/temporal_pddl/heuristics/heuristic.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

class AvoidsDeadPairs final : public Heuristic {
 public:
  // patience: how many evaluations come before the tables.
  AvoidsDeadPairs(const Task& task, Heuristic& heuristic, std::size_t patience, Watch& watch)
      : task_(task), heuristic_(heuristic), patience_(patience), watch_(watch) {}

  void evaluate(const Situation& situation, Estimate& estimate) override;
  bool hopeless(StateView state, std::span<const ActionId> running, ActionSteps steps) override;
  std::size_t bytes() const override;

 private:
  struct Table {
    bool tried = false;
    std::optional<DeadPairs> pairs;  // none: too dear
  };

  std::optional<DeadPairs> find(ActionSteps steps);

  const Task& task_;
  Heuristic& heuristic_;
  std::size_t patience_;
  Watch& watch_;
  std::array<Table, 2> tables_;  // by ActionSteps
};

}  // namespace roci::planner::temporal_pddl
