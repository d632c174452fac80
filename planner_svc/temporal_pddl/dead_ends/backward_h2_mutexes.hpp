// Mutexes by h² backwards (Alcázar and Torralba 2015) are pairs of literals from which the goals are out of
// reach, without time and numbers. A state with such a pair is a dead end.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/dead_ends/forward_h2_mutexes.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Holds the pairs that were found. A state with one of them is a dead end.
class BackwardH2Mutexes {
 public:
  /// Finds the pairs for searches that take the actions as `steps` does: where each is one step, more pairs
  /// are mutex. Returns nothing if `go_on` has stopped it.
  static std::optional<BackwardH2Mutexes> find(const task::Task& task, FdrOperators steps,
                                               const H2WorkLimit& go_on);
  /// Returns what find() needs at most, in bytes, the steps left out.
  static std::size_t most_bytes(const FdrOperators& steps);

  /// Returns whether one of the pairs is in a state that the search has reached.
  bool in(task::StateView state, std::span<const task::ActionId> running);
  std::size_t bytes() const { return steps_.bytes() + dead_.bytes(); }

 private:
  // Holds some of the literals that are dead together with another one: a word of their bits.
  struct MutexWord {
    std::uint32_t word;
    BitWord bits;
  };

  explicit BackwardH2Mutexes(FdrOperators steps);
  void begin(const task::Task& task, const ForwardH2Mutexes& reachable);
  void keep_dead(const ForwardH2Mutexes& reachable);
  bool after(const FdrOperator& step);
  void regress(const FdrOperator& step, const ForwardH2Mutexes& reachable);
  void regress_loose(const FdrOperator& step, const UndeterminedVariable& variable,
                     const ForwardH2Mutexes& reachable);
  void relate(Literal literal, const FdrOperator& step, const ForwardH2Mutexes& reachable);
  bool possible(const ValueTransition& change) const {
    return before_.has(change.from) && after_.has(change.to);
  }

  FdrOperators steps_;
  task::FlatLists<MutexWord> dead_;  // by literal: from its own word on; of what is reachable
  H2Fixpoint alive_;                 // while they are looked for
  Bits before_, after_, rest_, others_, state_;
  std::vector<Literal> literals_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
