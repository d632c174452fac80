#include "planner_svc/temporal_pddl/dead_ends/forward_h2_mutexes.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl::dead_ends {

using task::Task;

std::optional<ForwardH2Mutexes> ForwardH2Mutexes::find(const Task& task, const FdrOperators& steps,
                                                       const H2WorkLimit& go_on) {
  ForwardH2Mutexes result(steps);
  result.begin(task, steps);
  const auto reads = [](const FdrOperator& step, const auto& is_new) {
    const auto new_before = [&](const ValueTransition& change) { return is_new(change.from); };
    return std::ranges::any_of(step.fixed, new_before) || (step.fixed.empty() && is_new(kNoLiteral)) ||
           std::ranges::any_of(step.loose, [&](const UndeterminedVariable& variable) {
             return std::ranges::any_of(step.of(variable), new_before);
           });
  };
  const auto take = [&](const FdrOperator& step) { result.take(step); };
  if (!result.pairs_.close(steps, reads, take, go_on)) return std::nullopt;
  result.forbidden_ = PairMatrix();
  return result;
}

ForwardH2Mutexes::ForwardH2Mutexes(const FdrOperators& steps)
    : pairs_(steps.literals()),
      before_(steps.literals()),
      rest_(steps.literals()),
      others_(steps.literals()) {}

void ForwardH2Mutexes::begin(const Task& task, const FdrOperators& steps) {
  steps.each_forbidden([&](Literal runs, Literal literal) {
    if (forbidden_.empty()) forbidden_ = PairMatrix(steps.literals());
    forbidden_.set(runs, literal);
  });
  steps.each_literal(task.initial_state, {}, [&](Literal literal) { others_.set(literal); });
  steps.each_literal(task.initial_state, {}, [&](Literal literal) { pairs_.relate(literal, others_); });
}

bool ForwardH2Mutexes::before(const FdrOperator& step, Bits& literals) const {
  literals = pairs_.singles();
  for (const ValueTransition& change : step.fixed) {
    if (change.from != kNoLiteral) literals.keep(with(change.from));
  }
  const auto possible = [&](const ValueTransition& change) {
    return change.from == kNoLiteral || literals.has(change.from);
  };
  return std::ranges::all_of(step.fixed, possible) &&
         std::ranges::all_of(step.loose, [&](const UndeterminedVariable& variable) {
           return std::ranges::any_of(step.of(variable), possible);
         });
}

void leave_out_touched(const FdrOperator& step, Bits& literals) {
  for (const LiteralRange range : step.touched) literals.clear(range.begin, range.end);
}

// Relates the literal to others_, without what it forbids.
void ForwardH2Mutexes::relate(Literal literal) {
  if (!forbidden_.empty()) others_.leave_out(forbidden_.row(literal));
  pairs_.relate(literal, others_);
}

void ForwardH2Mutexes::take(const FdrOperator& step) {
  pairs_.count(step.fixed.size() + step.ends.size() + 3);
  if (!before(step, before_)) return;
  rest_ = before_;
  leave_out_touched(step, rest_);
  for (const Literal end : step.ends) {
    others_ = rest_;
    for (const Literal other : step.ends) others_.set(other);
    relate(end);
  }
  for (const UndeterminedVariable& variable : step.loose) {
    if (!variable.settled) take_loose(step, variable);
  }
}

void ForwardH2Mutexes::take_loose(const FdrOperator& step, const UndeterminedVariable& variable) {
  for (const ValueTransition& change : step.of(variable)) {
    if (!before_.has(change.from)) continue;
    others_.clear_all();
    if (change.from != change.to) {
      others_ = rest_;
      others_.keep(with(change.from));
    }
    others_.set(change.to);
    for (const Literal end : step.ends) others_.set(end);
    for (const UndeterminedVariable& second : step.loose) {
      if (&second == &variable) continue;
      for (const ValueTransition& other : step.of(second)) {
        if (before_.has(other.from) && together(change.from, other.from)) others_.set(other.to);
      }
    }
    pairs_.count(2);
    relate(change.to);
  }
}

}  // namespace roci::planner::temporal_pddl::dead_ends
