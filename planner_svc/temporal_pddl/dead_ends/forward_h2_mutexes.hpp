// Mutexes by h² forwards (Haslum and Geffner 2000), without time and numbers, are all pairs of literals but
// those that may hold together in a state that the search reaches.
#pragma once

#include <optional>
#include <span>

#include "planner_svc/temporal_pddl/dead_ends/fdr_operators.hpp"
#include "planner_svc/temporal_pddl/dead_ends/h2_fixpoint.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Holds which pairs of literals may hold together; all others are mutex.
class ForwardH2Mutexes {
 public:
  /// Finds the pairs. Returns nothing if `go_on` has stopped it.
  static std::optional<ForwardH2Mutexes> find(const task::Task& task, const FdrOperators& steps,
                                              const H2WorkLimit& go_on);

  bool together(Literal a, Literal b) const { return pairs_.matrix().has(a, b); }
  std::span<const BitWord> with(Literal a) const { return pairs_.matrix().row(a); }
  /// Fills in what may hold before the step, the values of what it touches among it. Returns false if it can
  /// never be taken.
  bool before(const FdrOperator& step, Bits& literals) const;

 private:
  explicit ForwardH2Mutexes(const FdrOperators& steps);
  void begin(const task::Task& task, const FdrOperators& steps);
  void take(const FdrOperator& step);
  void take_loose(const FdrOperator& step, const UndeterminedVariable& variable);
  void relate(Literal literal);

  H2Fixpoint pairs_;
  PairMatrix forbidden_;  // by invariants; empty: none
  Bits before_, rest_, others_;
};

/// Removes the literals of what the step touches.
void leave_out_touched(const FdrOperator& step, Bits& literals);

}  // namespace roci::planner::temporal_pddl::dead_ends
