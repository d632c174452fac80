// This is the task as operators on finite-domain variables (FDR, also SAS+), without time, numbers and
// derived facts. Each transition of a search is one of these steps or a start and an end of them, so what
// they cannot reach is out of reach.
//
// A literal is a value of a variable, 0 (none of its facts) among them, or "action a runs". An operator
// touches some variables: it says which values they may have before it and what each of these becomes. All
// others stay as they are.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/action_compression.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

using Literal = std::uint32_t;
constexpr Literal kNoLiteral = std::numeric_limits<Literal>::max();

/// Holds the literals from `begin` on and before `end`.
struct LiteralRange {
  Literal begin = 0;
  Literal end = 0;
  bool empty() const { return begin == end; }
};

/// Tells what an operator makes of one value of a variable.
struct ValueTransition {
  Literal from;  ///< is kNoLiteral for "a does not run", which is no literal
  Literal to;    ///< is kNoLiteral likewise
};

/// Describes a variable that may have one of several values before an operator.
struct UndeterminedVariable {
  std::uint32_t begin, end;  ///< its transitions, among FdrOperator::loose_changes
  bool settled;              ///< whether all lead to the same value
};

/// Shows one operator of FdrOperators; it is valid as long as these.
struct FdrOperator {
  std::span<const ValueTransition> fixed;       ///< the variables that may have one value only
  std::span<const UndeterminedVariable> loose;  ///< the others that it touches
  std::span<const Literal> ends;                ///< the literals that hold after it in any case
  std::span<const LiteralRange> touched;        ///< the literals of all these variables
  std::span<const ValueTransition> loose_changes;

  std::span<const ValueTransition> of(const UndeterminedVariable& variable) const {
    return loose_changes.subspan(variable.begin, variable.end - variable.begin);
  }
};

/// Holds all operators of a task for one way to take actions. The task must outlive it.
class FdrOperators {
 public:
  /// Makes the operators. Where actions are always compressed, each is one; else each is one where the
  /// search may end it at once, and a start and an end where it may not. `poll` is called every few
  /// microseconds.
  FdrOperators(const task::Task& task, task::ActionCompression style, const std::function<void()>& poll);

  /// Returns how many literals there are at most.
  static std::size_t literals(const task::Task& task, task::ActionCompression style);
  std::size_t literals() const { return literals_; }
  std::size_t size() const { return fixed_.size(); }
  FdrOperator operator[](std::size_t step) const {
    return {fixed_[step], loose_[step], ends_[step], touched_[step], loose_changes_};
  }

  /// Calls visit(literal) for what holds in a state, derived facts left out.
  template <typename Visit>
  void each_literal(task::StateView state, std::span<const task::ActionId> running,
                    const Visit& visit) const {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (!variables_[i].empty()) visit(variables_[i].begin + task_.layout.value(state, i));
    }
    for (const task::ActionId action : running) {
      if (running_[action] != kNoLiteral) visit(running_[action]);
    }
  }
  /// Calls visit(literal, only) for what may hold in a state where these facts hold and nothing runs; `only`
  /// says that no other value of its variable may.
  template <typename Visit>
  void each_agreeing(std::span<const task::FactId> facts, const Visit& visit) const {
    for (std::size_t variable = 0; variable < variables_.size(); ++variable) {
      const LiteralRange range = variables_[variable];
      const auto agrees = [&](Literal literal) { return allows(facts, variable, literal - range.begin); };
      std::size_t count = 0;
      for (Literal literal = range.begin; literal < range.end; ++literal) count += agrees(literal);
      for (Literal literal = range.begin; literal < range.end; ++literal) {
        if (agrees(literal)) visit(literal, count == 1);
      }
    }
  }
  /// Calls visit(runs, literal) for what an invariant forbids while its action runs.
  template <typename Visit>
  void each_forbidden(const Visit& visit) const {
    for (std::size_t i = 0; i < running_.size(); ++i) {
      const task::ActionId action(i);
      if (running_[action] == kNoLiteral) continue;
      for (const task::FactId fact : task_.invariants[action]) {
        const LiteralRange range = variables_[task_.layout.variable_of(fact)];
        for (Literal literal = range.begin; literal < range.end; ++literal) {
          if (!allows(fact, literal - range.begin)) visit(running_[action], literal);
        }
      }
    }
  }
  std::size_t bytes() const;

 private:
  struct Phase;

  bool allows(task::FactId fact, std::uint32_t value) const {
    return (task_.layout.value_of(fact) == value) != task_.layout.is_negation(fact);
  }
  // Returns whether the facts, as far as they speak of the variable, allow the value.
  bool allows(std::span<const task::FactId> facts, std::size_t variable, std::uint32_t value) const;
  void add_steps(task::ActionId action, task::ActionCompression style);
  void add_step(std::span<const Phase> phases, ValueTransition running);
  std::vector<std::size_t> touched_by(std::span<const Phase> phases) const;
  std::vector<ValueTransition> changes(std::span<const Phase> phases, std::size_t variable) const;

  const task::Task& task_;
  std::vector<LiteralRange> variables_;              // of the layout; of derived ones empty
  task::IdVector<task::ActionId, Literal> running_;  // kNoLiteral: it is never seen running
  std::size_t literals_ = 0;
  task::FlatLists<ValueTransition> fixed_;  // by step, as all that follow
  task::FlatLists<UndeterminedVariable> loose_;
  task::FlatLists<Literal> ends_;
  task::FlatLists<LiteralRange> touched_;
  std::vector<ValueTransition> loose_changes_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
