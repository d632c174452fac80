// The task as steps on finite-domain values, without time, numbers and derived facts. Each transition of a
// search is one of these steps or a start and an end of them, so what they cannot reach is out of reach.
//
// A literal is a value of a variable, 0 (none of its facts) among them, or "action a runs". A step touches
// some variables: which values they may have before it and what each of these becomes. All others stay as
// they are.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/action_steps.hpp"
#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

using Literal = std::uint32_t;
constexpr Literal kNoLiteral = std::numeric_limits<Literal>::max();

struct LiteralRange {
  Literal begin = 0;
  Literal end = 0;
  bool empty() const { return begin == end; }
};

// Of one variable, by a step.
struct ValueChange {
  Literal from;  // kNoLiteral: "a does not run", which is no literal
  Literal to;    // likewise
};

// A variable that may have one of several values before a step.
struct LooseVariable {
  std::uint32_t begin, end;  // its changes, among ValueStep::loose_changes
  bool settled;              // all lead to the same value
};

struct ValueStep {
  std::span<const ValueChange> fixed;     // variables that may have one value only
  std::span<const LooseVariable> loose;   // the others that it touches
  std::span<const Literal> ends;          // what holds after it in any case
  std::span<const LiteralRange> touched;  // literals of all these variables
  std::span<const ValueChange> loose_changes;

  std::span<const ValueChange> of(const LooseVariable& variable) const {
    return loose_changes.subspan(variable.begin, variable.end - variable.begin);
  }
};

class ValueSteps {
 public:
  // style: where actions are taken whole, each is one step; else where the search may end it at once, and a
  // start and an end where it may not. poll: called every few microseconds.
  ValueSteps(const Task& task, ActionSteps style, const std::function<void()>& poll);

  // How many there are at most.
  static std::size_t literals(const Task& task, ActionSteps style);
  std::size_t literals() const { return literals_; }
  std::size_t size() const { return fixed_.size(); }
  ValueStep operator[](std::size_t step) const {
    return {fixed_[step], loose_[step], ends_[step], touched_[step], loose_changes_};
  }

  // Calls visit(literal) for what holds in a state, derived facts left out.
  template <typename Visit>
  void each_literal(StateView state, std::span<const ActionId> running, const Visit& visit) const {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (!variables_[i].empty()) visit(variables_[i].begin + task_.layout.value(state, i));
    }
    for (const ActionId action : running) {
      if (running_[action] != kNoLiteral) visit(running_[action]);
    }
  }
  // Calls visit(literal, only) for what may hold in a state where these facts hold and nothing runs. only: no
  // other value of its variable may.
  template <typename Visit>
  void each_agreeing(std::span<const FactId> facts, const Visit& visit) const {
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
  // Calls visit(runs, literal) for what an invariant forbids while its action runs.
  template <typename Visit>
  void each_forbidden(const Visit& visit) const {
    for (std::size_t i = 0; i < running_.size(); ++i) {
      const ActionId action(i);
      if (running_[action] == kNoLiteral) continue;
      for (const FactId fact : task_.invariants[action]) {
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

  bool allows(FactId fact, std::uint32_t value) const {
    return (task_.layout.value_of(fact) == value) != task_.layout.is_negation(fact);
  }
  // As far as they speak of the variable.
  bool allows(std::span<const FactId> facts, std::size_t variable, std::uint32_t value) const;
  void add_steps(ActionId action, ActionSteps style);
  void add_step(std::span<const Phase> phases, ValueChange running);
  std::vector<std::size_t> touched_by(std::span<const Phase> phases) const;
  std::vector<ValueChange> changes(std::span<const Phase> phases, std::size_t variable) const;

  const Task& task_;
  std::vector<LiteralRange> variables_;  // of the layout; of derived ones empty
  IdVector<ActionId, Literal> running_;  // kNoLiteral: it is never seen running
  std::size_t literals_ = 0;
  FlatLists<ValueChange> fixed_;  // by step, as all that follow
  FlatLists<LooseVariable> loose_;
  FlatLists<Literal> ends_;
  FlatLists<LiteralRange> touched_;
  std::vector<ValueChange> loose_changes_;
};

}  // namespace roci::planner::temporal_pddl
