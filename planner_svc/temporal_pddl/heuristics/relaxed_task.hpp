// The task without time and numbers (R15): what the FF heuristic computes on.
//
// Propositions are the facts and, for each durative action a, r_a: "a is running" (R18). Operators are the
// snap actions:
//   start of a   cost: least duration of a    needs pre⊢ and what of pre↔ the start does not add (R16)   adds
//   eff⊢, r_a end of a     cost: 0                      needs pre⊣ and r_a (R17) adds eff⊣ timed literal
//   cost: 0                    needs nothing                                               adds its facts
// Deletes do not exist.
#pragma once

#include <cstdint>

#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

using PropositionId = Id<struct PropositionTag>;

enum class CostMeasure {
  duration,  // of each action, at least, in microseconds
  metric,    // what it adds to the metric at first, in millionths
};

class RelaxedTask {
 public:
  explicit RelaxedTask(const Task& task, CostMeasure measure = CostMeasure::duration);

  std::size_t propositions() const { return facts_ + running_; }
  std::size_t operators() const { return costs_.size(); }
  PropositionId proposition(FactId fact) const { return PropositionId(fact.index()); }
  PropositionId running(ActionId action) const { return PropositionId(facts_ + action.index()); }

  // Calls visit(fact) for each fact that holds in the state.
  template <typename Visit>
  static void each_fact(const Task& task, StateView state, const Visit& visit) {
    const auto variables = task.layout.variables();
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const std::uint32_t value = task.layout.value(state, i);
      if (value > 0) visit(variables[i].facts[value - 1]);
    }
    for (const FactId fact : task.layout.negations()) {
      if (task.layout.holds(state, fact)) visit(fact);
    }
  }

  // Operators are numbered as the snap actions.
  std::int64_t cost(SnapId op) const { return costs_[op]; }
  std::span<const PropositionId> needs(SnapId op) const { return lists_[2 * op.index()]; }
  std::span<const PropositionId> adds(SnapId op) const { return lists_[2 * op.index() + 1]; }
  std::span<const SnapId> needed_by(PropositionId proposition) const { return needed_by_[proposition]; }
  std::span<const SnapId> added_by(PropositionId proposition) const { return added_by_[proposition]; }
  // A step that the planner chooses, and not what follows from one.
  bool is_choice(SnapId op) const { return is_choice_[op] != 0; }
  std::size_t bytes() const {
    return costs_.bytes() + lists_.bytes() + needed_by_.bytes() + is_choice_.bytes();
  }
  // Needs nothing and is no timed literal.
  const std::vector<SnapId>& free() const { return free_; }

 private:
  std::size_t facts_;
  std::size_t running_;
  IdVector<SnapId, std::int64_t> costs_;
  FlatLists<PropositionId> lists_;  // needs and adds of each operator, next to each other
  FlatLists<SnapId> needed_by_, added_by_;
  IdVector<SnapId, std::uint8_t> is_choice_;
  std::vector<SnapId> free_;
};

}  // namespace roci::planner::temporal_pddl
