// Which pairs of literals may hold together in a state that the search reaches: h² (Haslum and Geffner 2000),
// without time and numbers. All others are mutex.
#pragma once

#include <optional>
#include <span>

#include "planner_svc/temporal_pddl/dead_ends/pair_closure.hpp"
#include "planner_svc/temporal_pddl/dead_ends/value_steps.hpp"

namespace roci::planner::temporal_pddl {

class ReachablePairs {
 public:
  // None: stopped by `watch`.
  static std::optional<ReachablePairs> find(const Task& task, const ValueSteps& steps,
                                            const PairWatch& watch);

  bool together(Literal a, Literal b) const { return pairs_.matrix().has(a, b); }
  std::span<const BitWord> with(Literal a) const { return pairs_.matrix().row(a); }
  // Fills in what may hold before the step, the values of what it touches among it. False: it can never be
  // taken.
  bool before(const ValueStep& step, Bits& literals) const;

 private:
  explicit ReachablePairs(const ValueSteps& steps);
  void begin(const Task& task, const ValueSteps& steps);
  void take(const ValueStep& step);
  void take_loose(const ValueStep& step, const LooseVariable& variable);
  void relate(Literal literal);

  PairClosure pairs_;
  PairMatrix forbidden_;  // by invariants; empty: none
  Bits before_, rest_, others_;
};

// Removes the literals of what the step touches.
void leave_out_touched(const ValueStep& step, Bits& literals);

}  // namespace roci::planner::temporal_pddl
