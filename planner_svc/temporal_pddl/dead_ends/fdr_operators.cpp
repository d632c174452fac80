#include "planner_svc/temporal_pddl/dead_ends/fdr_operators.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::dead_ends {

using task::Action, task::ActionCompression, task::ActionId, task::FactId, task::SnapId, task::Task,
    task::TimedStep;

// Is a snap action with what else must hold right before or right after it.
struct FdrOperators::Phase {
  SnapId snap;
  std::span<const FactId> before = {};
  std::span<const FactId> after = {};
};

FdrOperators::FdrOperators(const Task& task, ActionCompression style, const std::function<void()>& poll)
    : task_(task), running_(task.actions.size(), kNoLiteral) {
  for (const auto& variable : task.layout.variables()) {
    const bool derived =
        std::ranges::any_of(variable.facts, [&](FactId fact) { return task.is_derived[fact]; });
    const std::size_t begin = literals_;
    literals_ += derived ? 0 : variable.facts.size() + 1;
    variables_.push_back({static_cast<Literal>(begin), static_cast<Literal>(literals_)});
  }
  for (std::size_t i = 0; i < task.actions.size(); ++i) {
    add_steps(ActionId(i), style);
    poll();
  }
  for (const TimedStep& timed : task.timed_steps)
    add_step(std::vector<Phase>{{timed.snap}}, {kNoLiteral, kNoLiteral});
}

std::size_t FdrOperators::literals(const Task& task, ActionCompression style) {
  return task.layout.facts() + task.layout.variables().size() +
         (style == ActionCompression::always ? 0 : task.actions.size());
}

void FdrOperators::add_steps(ActionId id, ActionCompression style) {
  const Action& action = task_.actions[id];
  const auto invariants = task_.invariants[id];
  if (action.instantaneous()) {
    add_step(std::vector<Phase>{{action.start}}, {kNoLiteral, kNoLiteral});
    return;
  }
  const bool whole = style == ActionCompression::always;
  if (whole || action.compression_safe)
    add_step(std::vector<Phase>{{action.start, {}, invariants}, {action.end}}, {kNoLiteral, kNoLiteral});
  if (whole || (action.compression_safe && task_.absent_for_compression[id].empty())) return;
  running_[id] = static_cast<Literal>(literals_++);
  add_step(std::vector<Phase>{{action.start, {}, invariants}}, {kNoLiteral, running_[id]});
  add_step(std::vector<Phase>{{action.end, invariants, {}}}, {running_[id], kNoLiteral});
}

bool FdrOperators::allows(std::span<const FactId> facts, std::size_t variable, std::uint32_t value) const {
  return std::ranges::all_of(
      facts, [&](FactId fact) { return task_.layout.variable_of(fact) != variable || allows(fact, value); });
}

std::vector<std::size_t> FdrOperators::touched_by(std::span<const Phase> phases) const {
  std::vector<std::size_t> result;
  for (const Phase& phase : phases) {
    for (const auto& facts : {phase.before, phase.after, task_.conditions[phase.snap], task_.adds[phase.snap],
                              task_.deletes[phase.snap]}) {
      for (const FactId fact : facts) result.push_back(task_.layout.variable_of(fact));
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](std::size_t variable) { return variables_[variable].empty(); });
  return result;
}

// Returns what each value that the variable may have before the first phase has become after the last.
std::vector<ValueTransition> FdrOperators::changes(std::span<const Phase> phases,
                                                   std::size_t variable) const {
  const LiteralRange range = variables_[variable];
  std::vector<ValueTransition> result;
  std::uint32_t value = 0;
  const auto set = [&](FactId fact, bool added) {
    if (task_.layout.variable_of(fact) != variable || task_.layout.is_negation(fact)) return;
    if (added) value = task_.layout.value_of(fact);
    if (!added && value == task_.layout.value_of(fact)) value = 0;
  };
  for (Literal from = range.begin; from < range.end; ++from) {
    value = from - range.begin;
    const bool possible = std::ranges::all_of(phases, [&](const Phase& phase) {
      if (!allows(phase.before, variable, value)) return false;
      if (!allows(task_.conditions[phase.snap], variable, value)) return false;
      for (const FactId fact : task_.deletes[phase.snap]) set(fact, false);
      for (const FactId fact : task_.adds[phase.snap]) set(fact, true);
      return allows(phase.after, variable, value);
    });
    if (possible) result.push_back({from, range.begin + value});
  }
  return result;
}

// Adds the phases as one operator; `running` says what becomes of "a runs".
void FdrOperators::add_step(std::span<const Phase> phases, ValueTransition running) {
  std::vector<ValueTransition> fixed, changes_of_loose;
  std::vector<UndeterminedVariable> loose;
  std::vector<Literal> ends;
  std::vector<LiteralRange> touched;
  for (const std::size_t variable : touched_by(phases)) {
    const auto changes = this->changes(phases, variable);
    if (changes.empty()) return;  // it can never be taken
    touched.push_back(variables_[variable]);
    const Literal to = changes.front().to;
    const bool settled =
        std::ranges::all_of(changes, [&](const ValueTransition& change) { return change.to == to; });
    if (settled) ends.push_back(to);
    if (changes.size() == 1) {
      fixed.push_back(changes.front());
      continue;
    }
    const std::size_t begin = loose_changes_.size() + changes_of_loose.size();
    loose.push_back(
        {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + changes.size()), settled});
    changes_of_loose.insert(changes_of_loose.end(), changes.begin(), changes.end());
  }
  for (const Literal literal : {running.from, running.to}) {
    if (literal != kNoLiteral) touched.push_back({literal, literal + 1});
  }
  if (running.from != kNoLiteral || running.to != kNoLiteral) fixed.push_back(running);
  if (running.to != kNoLiteral) ends.push_back(running.to);
  fixed_.push_back(fixed);
  loose_.push_back(loose);
  ends_.push_back(ends);
  touched_.push_back(touched);
  loose_changes_.insert(loose_changes_.end(), changes_of_loose.begin(), changes_of_loose.end());
}

std::size_t FdrOperators::bytes() const {
  return fixed_.bytes() + loose_.bytes() + ends_.bytes() + touched_.bytes() +
         loose_changes_.capacity() * sizeof(ValueTransition) + variables_.capacity() * sizeof(LiteralRange) +
         running_.size() * sizeof(Literal);
}

}  // namespace roci::planner::temporal_pddl::dead_ends
