#include "planner_svc/temporal_pddl/dead_ends/backward_h2_mutexes.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::temporal_pddl::dead_ends {

using task::ActionId, task::Goal, task::StateView, task::Task;

std::optional<BackwardH2Mutexes> BackwardH2Mutexes::find(const Task& task, FdrOperators steps,
                                                         const H2WorkLimit& go_on) {
  BackwardH2Mutexes result(std::move(steps));
  const auto reachable = ForwardH2Mutexes::find(task, result.steps_, go_on);
  if (!reachable) return std::nullopt;
  result.begin(task, *reachable);
  const auto reads = [](const FdrOperator& step, const auto& is_new) {
    return std::ranges::any_of(step.ends, is_new) || (step.ends.empty() && is_new(kNoLiteral)) ||
           std::ranges::any_of(step.loose, [&](const UndeterminedVariable& variable) {
             return !variable.settled &&
                    std::ranges::any_of(step.of(variable),
                                        [&](const ValueTransition& change) { return is_new(change.to); });
           });
  };
  const auto regress = [&](const FdrOperator& step) { result.regress(step, *reachable); };
  if (!result.alive_.close(result.steps_, reads, regress, go_on)) return std::nullopt;
  result.keep_dead(*reachable);
  return result;
}

// Keeps by literal the partners with which it is reachable and dead; most literals have none.
void BackwardH2Mutexes::keep_dead(const ForwardH2Mutexes& reachable) {
  std::vector<MutexWord> words;
  for (Literal literal = 0; literal < steps_.literals(); ++literal) {
    words.clear();
    const auto alive = alive_.matrix().row(literal);
    const auto reached = reachable.with(literal);
    for (std::size_t word = literal / 64; word < alive.size(); ++word) {
      const BitWord dead = reached[word] & ~alive[word];
      if (dead != 0) words.push_back({static_cast<std::uint32_t>(word), dead});
    }
    dead_.push_back(words);
  }
  alive_ = H2Fixpoint(0);
}

std::size_t BackwardH2Mutexes::most_bytes(const FdrOperators& steps) {
  return 2 * PairMatrix::bytes(steps.literals()) + steps.size() * sizeof(std::uint32_t);
}

BackwardH2Mutexes::BackwardH2Mutexes(FdrOperators steps)
    : steps_(std::move(steps)),
      alive_(0),
      before_(steps_.literals()),
      after_(steps_.literals()),
      rest_(steps_.literals()),
      others_(steps_.literals()),
      state_(steps_.literals()) {}

// Relates what may hold together with all goals of an alternative.
void BackwardH2Mutexes::begin(const Task& task, const ForwardH2Mutexes& reachable) {
  alive_ = H2Fixpoint(steps_.literals());
  for (const Goal& goal : task.goals) {
    rest_.clear_all();
    steps_.each_agreeing(goal.facts, [&](Literal literal, bool) { rest_.set(literal); });
    steps_.each_agreeing(goal.facts, [&](Literal literal, bool only) {
      if (only) rest_.keep(reachable.with(literal));
    });
    steps_.each_agreeing(goal.facts, [&](Literal literal, bool) {
      if (!rest_.has(literal)) return;
      others_ = rest_;
      others_.keep(reachable.with(literal));
      alive_.relate(literal, others_);
    });
  }
}

// Fills in what may hold after the step and is alive with all that does in any case. Returns false if that is
// dead.
bool BackwardH2Mutexes::after(const FdrOperator& step) {
  after_ = alive_.singles();
  for (const Literal end : step.ends) after_.keep(alive_.matrix().row(end));
  return std::ranges::all_of(step.ends, [&](Literal end) { return after_.has(end); });
}

void BackwardH2Mutexes::regress(const FdrOperator& step, const ForwardH2Mutexes& reachable) {
  alive_.count(step.fixed.size() + step.ends.size() + 4);
  if (!after(step) || !reachable.before(step, before_)) return;
  const bool taken = std::ranges::all_of(step.loose, [&](const UndeterminedVariable& variable) {
    return std::ranges::any_of(step.of(variable),
                               [&](const ValueTransition& change) { return possible(change); });
  });
  if (!taken) return;
  rest_ = before_;
  rest_.keep(after_.words());
  leave_out_touched(step, rest_);
  for (const ValueTransition& change : step.fixed) {
    if (change.from == kNoLiteral) continue;
    others_ = rest_;
    relate(change.from, step, reachable);
  }
  for (const UndeterminedVariable& variable : step.loose) regress_loose(step, variable, reachable);
}

void BackwardH2Mutexes::regress_loose(const FdrOperator& step, const UndeterminedVariable& variable,
                                      const ForwardH2Mutexes& reachable) {
  for (const ValueTransition& change : step.of(variable)) {
    if (!possible(change)) continue;
    others_.clear_all();
    if (change.from != change.to) {
      others_ = rest_;
      if (!variable.settled) others_.keep(alive_.matrix().row(change.to));
    }
    others_.set(change.from);
    for (const UndeterminedVariable& second : step.loose) {
      if (&second == &variable) continue;
      for (const ValueTransition& other : step.of(second)) {
        if (possible(other) && alive_.matrix().has(change.to, other.to)) others_.set(other.from);
      }
    }
    alive_.count(2);
    relate(change.from, step, reachable);
  }
}

// Relates the literal to others_ and to what the step asks for, as far as they may hold together.
void BackwardH2Mutexes::relate(Literal literal, const FdrOperator& step, const ForwardH2Mutexes& reachable) {
  for (const ValueTransition& change : step.fixed) {
    if (change.from != kNoLiteral) others_.set(change.from);
  }
  others_.keep(reachable.with(literal));
  alive_.count(1);
  alive_.relate(literal, others_);
}

bool BackwardH2Mutexes::in(StateView state, std::span<const ActionId> running) {
  literals_.clear();
  state_.clear_all();
  steps_.each_literal(state, running, [&](Literal literal) {
    literals_.push_back(literal);
    state_.set(literal);
  });
  return std::ranges::any_of(literals_, [&](Literal literal) {
    return std::ranges::any_of(dead_[std::size_t{literal}], [&](const MutexWord& dead) {
      return (state_.words()[dead.word] & dead.bits) != 0;
    });
  });
}

}  // namespace roci::planner::temporal_pddl::dead_ends
