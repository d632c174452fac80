// Pairs of literals from which the goals are out of reach: h² backwards (Alcázar and Torralba 2015), without
// time and numbers. A state with such a pair is a dead end.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/reachable_pairs.hpp"

namespace roci::planner::temporal_pddl {

class DeadPairs {
 public:
  // For searches that take the actions as `steps` does: where each is one step, more pairs are dead. None:
  // stopped by `watch`.
  static std::optional<DeadPairs> find(const Task& task, ValueSteps steps, const PairWatch& watch);
  // What find() needs at most, the steps left out.
  static std::size_t most_bytes(const ValueSteps& steps);

  // Is one of them in a state that the search has reached?
  bool in(StateView state, std::span<const ActionId> running);
  std::size_t bytes() const { return steps_.bytes() + dead_.bytes(); }

 private:
  // Some of the literals that are dead together with another one: a word of their bits.
  struct DeadWord {
    std::uint32_t word;
    BitWord bits;
  };

  explicit DeadPairs(ValueSteps steps);
  void begin(const Task& task, const ReachablePairs& reachable);
  void keep_dead(const ReachablePairs& reachable);
  bool after(const ValueStep& step);
  void regress(const ValueStep& step, const ReachablePairs& reachable);
  void regress_loose(const ValueStep& step, const LooseVariable& variable, const ReachablePairs& reachable);
  void relate(Literal literal, const ValueStep& step, const ReachablePairs& reachable);
  bool possible(const ValueChange& change) const { return before_.has(change.from) && after_.has(change.to); }

  ValueSteps steps_;
  FlatLists<DeadWord> dead_;  // by literal: from its own word on; of what is reachable
  PairClosure alive_;         // while they are looked for
  Bits before_, after_, rest_, others_, state_;
  std::vector<Literal> literals_;
};

}  // namespace roci::planner::temporal_pddl
