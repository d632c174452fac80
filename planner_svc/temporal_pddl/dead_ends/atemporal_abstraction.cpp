#include "planner_svc/temporal_pddl/dead_ends/atemporal_abstraction.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::dead_ends {

using task::Action, task::ActionId, task::FactId, task::Goal, task::SnapId, task::StateView, task::Task,
    task::TimedStep, task::Word;

AtemporalAbstraction::AtemporalAbstraction(const Task& task, std::span<const FactId> goals)
    : task_(task),
      words_(task.layout.words() - task.layout.numbers()),
      known_(task.layout.variables().size(), true),
      mask_(words_, 0),
      goals_(goals.begin(), goals.end()) {
  if (!goals.empty()) keep_relevant(goals);
  leave_out_unsteered();
  const auto variables = task.layout.variables();
  for (std::size_t i = 0; i < known_.size(); ++i) {
    if (known_[i]) mask_[variables[i].word] |= variables[i].mask << variables[i].shift;
  }
  for (const Action& action : task.actions) {
    start_tests_.push_back(tests_of(task.conditions[action.start]));
    changes_.push_back(changes_known(action.start) || changes_known(action.end));
  }
}

// A fact has a bearing on the goals if one of them is made of it, or an action that changes such a fact's
// variable asks for it.
void AtemporalAbstraction::keep_relevant(std::span<const FactId> goals) {
  known_.assign(known_.size(), false);
  const auto keep = [&](std::span<const FactId> facts) {
    bool changed = false;
    for (const FactId fact : facts) {
      const std::size_t variable = task_.layout.variable_of(fact);
      changed = changed || !known_[variable];
      known_[variable] = true;
    }
    return changed;
  };
  const auto matters = [&](std::span<const FactId> facts) {
    return std::ranges::any_of(facts, [&](FactId fact) { return known(fact); });
  };
  keep(goals);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < task_.actions.size(); ++i) {
      const ActionId id(i);
      const Action& action = task_.actions[id];
      if (!matters(task_.adds[action.start]) && !matters(task_.adds[action.end])) continue;
      changed = keep(task_.conditions[action.start]) || changed;
      changed = keep(task_.conditions[action.end]) || changed;
      changed = keep(task_.invariants[id]) || changed;
    }
  }
}

void AtemporalAbstraction::leave_out_unsteered() {
  for (std::size_t i = 0; i < task_.is_derived.size(); ++i) {
    if (task_.is_derived[FactId(i)]) known_[task_.layout.variable_of(FactId(i))] = false;
  }
  for (const TimedStep& timed : task_.timed_steps) {
    for (const auto facts : {task_.adds[timed.snap], task_.deletes[timed.snap]}) {
      for (const FactId fact : facts) known_[task_.layout.variable_of(fact)] = false;
    }
  }
}

bool AtemporalAbstraction::changes_known(SnapId snap) const {
  const auto is_known = [&](FactId fact) { return known(fact); };
  return std::ranges::any_of(task_.adds[snap], is_known) ||
         std::ranges::any_of(task_.deletes[snap], is_known);
}

// Makes one test per word that positive facts lie in. A contradiction is left to holds_all().
std::vector<AtemporalAbstraction::Test> AtemporalAbstraction::tests_of(std::span<const FactId> facts) const {
  std::vector<Test> result;
  std::vector<Word> needed(words_, 0);
  const auto variables = task_.layout.variables();
  for (const FactId fact : facts) {
    if (!known(fact) || task_.layout.is_negation(fact)) continue;
    task_.layout.add(needed, fact);
    const auto& variable = variables[task_.layout.variable_of(fact)];
    const Word mask = variable.mask << variable.shift;
    const auto same = std::ranges::find(result, variable.word, &Test::word);
    if (same == result.end()) {
      result.push_back({variable.word, mask, 0});
    } else {
      same->mask |= mask;
    }
  }
  for (Test& test : result) test.value = needed[test.word] & test.mask;
  return result;
}

bool AtemporalAbstraction::project(StateView state, std::span<const ActionId> running, Key& key) const {
  key.assign(key_words(), 0);
  for (std::size_t i = 0; i < words_; ++i) key[i] = state[i] & mask_[i];
  std::array<std::uint32_t, kMaxRunning> ids;
  ids.fill(ActionId::kNone);
  std::size_t noted = 0;
  for (const ActionId action : running) {
    if (!changes_[action]) continue;
    if (noted == kMaxRunning) return false;
    ids[noted++] = action.value;
  }
  std::ranges::sort(ids);
  for (std::size_t i = 0; i < kMaxRunning; ++i) key[words_ + i / 2] |= Word{ids[i]} << (i % 2 * 32);
  return true;
}

bool AtemporalAbstraction::is_goal(std::span<const Word> key) const {
  if (!std::ranges::all_of(key.subspan(words_), [](Word word) { return word == ~Word{0}; })) return false;
  const auto reached = [&](std::span<const FactId> facts) {
    return std::ranges::all_of(facts,
                               [&](FactId fact) { return !known(fact) || task_.layout.holds(key, fact); });
  };
  if (!goals_.empty()) return reached(goals_);
  return std::ranges::any_of(task_.goals, [&](const Goal& goal) { return reached(goal.facts); });
}

void AtemporalAbstraction::unpack(std::span<const Word> key) {
  before_.assign(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(words_));
  running_before_.clear();
  for (std::size_t i = 0; i < kMaxRunning; ++i) {
    const auto id = static_cast<std::uint32_t>(key[words_ + i / 2] >> (i % 2 * 32));
    if (id != ActionId::kNone) running_before_.emplace_back(std::size_t{id});
  }
  restore();
}

void AtemporalAbstraction::restore() {
  state_ = before_;
  running_ = running_before_;
}

void AtemporalAbstraction::pack() { project(state_, running_, next_); }

bool AtemporalAbstraction::is_running(ActionId action) const {
  return std::ranges::find(running_, action) != running_.end();
}

bool AtemporalAbstraction::passes(std::span<const Test> tests) const {
  return std::ranges::all_of(tests,
                             [&](const Test& test) { return (state_[test.word] & test.mask) == test.value; });
}

bool AtemporalAbstraction::holds_all(std::span<const FactId> facts) const {
  return std::ranges::all_of(facts,
                             [&](FactId fact) { return !known(fact) || task_.layout.holds(state_, fact); });
}

AtemporalAbstraction::Ways AtemporalAbstraction::ways(ActionId action) const {
  if (!task_.actions[action].compression_safe) return {false, true};
  Ways result{true, false};
  for (const FactId fact : task_.absent_for_compression[action]) {
    if (!known(fact)) {
      result.apart = true;
    } else if (task_.layout.holds(state_, fact)) {
      return {false, true};
    }
  }
  return result;
}

void AtemporalAbstraction::apply(SnapId snap) {
  for (const FactId fact : task_.deletes[snap]) {
    if (known(fact)) task_.layout.remove(state_, fact);
  }
  for (const FactId fact : task_.adds[snap]) {
    if (known(fact)) task_.layout.add(state_, fact);
  }
}

bool AtemporalAbstraction::invariants_hold() const {
  return std::ranges::all_of(running_, [&](ActionId action) { return holds_all(task_.invariants[action]); });
}

bool AtemporalAbstraction::plain_step(ActionId action) {
  const SnapId snap = task_.actions[action].start;
  if (!holds_all(task_.conditions[snap])) return false;
  apply(snap);
  return invariants_hold();
}

bool AtemporalAbstraction::start_step(ActionId action) {
  state_ = before_;
  running_ = running_before_;
  if (!plain_step(action)) return false;
  running_.push_back(action);
  return holds_all(task_.invariants[action]);
}

bool AtemporalAbstraction::end_step(ActionId action) {
  const SnapId snap = task_.actions[action].end;
  if (!holds_all(task_.conditions[snap])) return false;
  apply(snap);
  std::erase(running_, action);
  return invariants_hold();
}

bool AtemporalAbstraction::compressed_step(ActionId action) { return start_step(action) && end_step(action); }

}  // namespace roci::planner::temporal_pddl::dead_ends
