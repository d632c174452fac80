// The relaxed task is the task without time and numbers (R15); the FF heuristic computes on it.
//
// Propositions are the facts and, for each durative action a, r_a: "a is running" (R18). Operators are the
// snap actions; deletes do not exist.
//
// clang-format off
//   operator        cost                  needs                                            adds
//   start of a      least duration of a   pre⊢ and what of pre↔ the start does not add     eff⊢, r_a
//                                         (R16)
//   end of a        0                     pre⊣ and r_a (R17)                               eff⊣
//   timed literal   0                     nothing                                          its facts
// clang-format on
#pragma once

#include <cstdint>

#include "planner_svc/temporal_pddl/task/flat_lists.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using PropositionId = task::Id<struct PropositionTag>;

/// Says what an operator costs.
enum class CostMeasure {
  duration,  ///< the least duration of each action, in microseconds
  metric,    ///< counts what each adds to the metric at first, in millionths
};

/// Holds the propositions and operators of a task: a proposition is a fact or "action a runs".
class RelaxedTask {
 public:
  explicit RelaxedTask(const task::Task& task, CostMeasure measure = CostMeasure::duration);

  std::size_t propositions() const { return facts_ + running_; }
  std::size_t operators() const { return costs_.size(); }
  PropositionId proposition(task::FactId fact) const { return PropositionId(fact.index()); }
  PropositionId running(task::ActionId action) const { return PropositionId(facts_ + action.index()); }

  /// Calls visit(fact) for each fact that holds in the state.
  template <typename Visit>
  static void each_fact(const task::Task& task, task::StateView state, const Visit& visit) {
    const auto variables = task.layout.variables();
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const std::uint32_t value = task.layout.value(state, i);
      if (value > 0) visit(variables[i].facts[value - 1]);
    }
    for (const task::FactId fact : task.layout.negations()) {
      if (task.layout.holds(state, fact)) visit(fact);
    }
  }

  /// Returns the cost; operators are numbered as the snap actions.
  std::int64_t cost(task::SnapId op) const { return costs_[op]; }
  std::span<const PropositionId> needs(task::SnapId op) const { return lists_[2 * op.index()]; }
  std::span<const PropositionId> adds(task::SnapId op) const { return lists_[2 * op.index() + 1]; }
  std::span<const task::SnapId> needed_by(PropositionId proposition) const { return needed_by_[proposition]; }
  std::span<const task::SnapId> added_by(PropositionId proposition) const { return added_by_[proposition]; }
  /// Returns whether the step is one that the planner chooses, and not what follows from one.
  bool is_choice(task::SnapId op) const { return is_choice_[op] != 0; }
  std::size_t bytes() const {
    return costs_.bytes() + lists_.bytes() + needed_by_.bytes() + added_by_.bytes() + is_choice_.bytes() +
           free_.capacity() * sizeof(task::SnapId);
  }
  /// Returns the operators that need nothing and are no timed literals.
  const std::vector<task::SnapId>& free() const { return free_; }

 private:
  std::size_t facts_;
  std::size_t running_;
  task::IdVector<task::SnapId, std::int64_t> costs_;
  task::FlatLists<PropositionId> lists_;  // needs and adds of each operator, next to each other
  task::FlatLists<task::SnapId> needed_by_, added_by_;
  task::IdVector<task::SnapId, std::uint8_t> is_choice_;
  std::vector<task::SnapId> free_;
};

}  // namespace roci::planner::temporal_pddl::heuristics
