// The task without time and numbers, and without the variables that are left out: a small space of states of
// which every plan of the task walks a path. So what is cheapest in it is never dearer in the task.
//
// It has the search's transitions: starts, ends, plain actions, and compressed actions (R14). What timed
// literals change, and what is derived, is always left out.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl {

class TimelessSpace {
 public:
  // The words of a state, and the running actions in ascending order behind them, two to a word.
  using Key = std::vector<Word>;
  static constexpr std::size_t kMaxRunning = 4;

  // goals: the facts of the task's only goal that count; the variables that have no bearing on them are left
  // out. Empty: all goals and all variables count.
  TimelessSpace(const Task& task, std::span<const FactId> goals);

  std::size_t key_words() const { return words_ + kMaxRunning / 2; }
  // False: more actions run than a key holds.
  bool project(StateView state, std::span<const ActionId> running, Key& key) const;
  bool is_goal(std::span<const Word> key) const;

  // Calls visit(snap, compressed) for each transition; the successor lies in next() then. False: some
  // successor runs more actions than a key holds.
  template <typename Visit>
  bool each_successor(std::span<const Word> key, const Visit& visit) {
    unpack(key);
    bool complete = true;
    for (std::size_t i = 0; i < task_.actions.size(); ++i) {
      const ActionId action(i);
      if (!changes_[action] || !passes(start_tests_[action]) || is_running(action)) continue;
      const bool plain = task_.actions[action].instantaneous();
      const auto [together, apart] = ways(action);
      if (plain ? plain_step(action) : together && compressed_step(action)) {
        pack();
        visit(task_.actions[action].start, !plain);
      }
      if (!plain && apart && start_step(action)) {
        if (running_.size() <= kMaxRunning) {
          pack();
          visit(task_.actions[action].start, false);
        } else {
          complete = false;
        }
      }
      restore();
    }
    for (const ActionId action : std::vector<ActionId>(running_)) {
      if (end_step(action)) {
        pack();
        visit(task_.actions[action].end, false);
      }
      restore();
    }
    return complete;
  }
  std::span<const Word> next() const { return next_; }

 private:
  struct Test {
    std::size_t word;
    Word mask, value;
  };
  struct Ways {
    bool together;  // the end at once
    bool apart;
  };

  void keep_relevant(std::span<const FactId> goals);
  void leave_out_unsteered();
  bool known(FactId fact) const { return known_[task_.layout.variable_of(fact)]; }
  bool changes_known(SnapId snap) const;
  std::vector<Test> tests_of(std::span<const FactId> facts) const;

  void unpack(std::span<const Word> key);
  void restore();
  void pack();
  bool is_running(ActionId action) const;
  bool passes(std::span<const Test> tests) const;
  bool holds_all(std::span<const FactId> facts) const;
  Ways ways(ActionId action) const;
  void apply(SnapId snap);
  bool invariants_hold() const;
  bool plain_step(ActionId action);
  bool compressed_step(ActionId action);
  bool start_step(ActionId action);
  bool end_step(ActionId action);

  const Task& task_;
  std::size_t words_;        // packed words of a state, numbers left out
  std::vector<bool> known_;  // by variable of the layout
  std::vector<Word> mask_;   // bits of the known variables
  std::vector<FactId> goals_;
  IdVector<ActionId, bool> changes_;  // a known variable; the others are not even noted as running
  IdVector<ActionId, std::vector<Test>> start_tests_;  // necessary for the start

  // Of each_successor().
  std::vector<Word> before_, state_, next_;
  std::vector<ActionId> running_before_, running_;
};

}  // namespace roci::planner::temporal_pddl
