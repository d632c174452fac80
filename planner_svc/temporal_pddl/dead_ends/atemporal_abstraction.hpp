// The atemporal abstraction of a task is a small space of states without time and numbers, and without the
// variables that are left out, of which every plan of the task walks a path. So what is cheapest in it is
// never dearer in the task (Culberson and Schaeffer 1998, on pattern databases).
//
// It has the transitions of the search: starts, ends, plain actions, and compressed actions (R14). What timed
// literals change, and what is derived, is always left out.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/task.hpp"

namespace roci::planner::temporal_pddl::dead_ends {

/// Leads from keys of abstract states to their successors. The task must outlive it.
class AtemporalAbstraction {
 public:
  /// Holds the words of a state and behind them the running actions in ascending order, two to a word.
  using Key = std::vector<task::Word>;
  static constexpr std::size_t kMaxRunning = 4;

  /// Abstracts the task. With `goals`, only these facts of the task's only goal count, and the variables
  /// that have no bearing on them are left out; with none, all goals and all variables count.
  AtemporalAbstraction(const task::Task& task, std::span<const task::FactId> goals);

  std::size_t key_words() const { return words_ + kMaxRunning / 2; }
  /// Returns false if more actions run than a key holds.
  bool project(task::StateView state, std::span<const task::ActionId> running, Key& key) const;
  bool is_goal(std::span<const task::Word> key) const;

  /// Calls visit(snap, compressed) for each transition; the successor lies in next() then. Returns false if
  /// some successor runs more actions than a key holds.
  template <typename Visit>
  bool each_successor(std::span<const task::Word> key, const Visit& visit) {
    unpack(key);
    bool complete = true;
    for (std::size_t i = 0; i < task_.actions.size(); ++i) {
      const task::ActionId action(i);
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
    for (const task::ActionId action : std::vector<task::ActionId>(running_)) {
      if (end_step(action)) {
        pack();
        visit(task_.actions[action].end, false);
      }
      restore();
    }
    return complete;
  }
  std::span<const task::Word> next() const { return next_; }

 private:
  struct Test {
    std::size_t word;
    task::Word mask, value;
  };
  struct Ways {
    bool together;  // the end at once
    bool apart;
  };

  void keep_relevant(std::span<const task::FactId> goals);
  void leave_out_unsteered();
  bool known(task::FactId fact) const { return known_[task_.layout.variable_of(fact)]; }
  bool changes_known(task::SnapId snap) const;
  std::vector<Test> tests_of(std::span<const task::FactId> facts) const;

  void unpack(std::span<const task::Word> key);
  void restore();
  void pack();
  bool is_running(task::ActionId action) const;
  bool passes(std::span<const Test> tests) const;
  bool holds_all(std::span<const task::FactId> facts) const;
  Ways ways(task::ActionId action) const;
  void apply(task::SnapId snap);
  bool invariants_hold() const;
  bool plain_step(task::ActionId action);
  bool compressed_step(task::ActionId action);
  bool start_step(task::ActionId action);
  bool end_step(task::ActionId action);

  const task::Task& task_;
  std::size_t words_;             // packed words of a state, numbers left out
  std::vector<bool> known_;       // by variable of the layout
  std::vector<task::Word> mask_;  // bits of the known variables
  std::vector<task::FactId> goals_;
  // Tells whether the action changes a known variable; the others are not even noted as running.
  task::IdVector<task::ActionId, bool> changes_;
  task::IdVector<task::ActionId, std::vector<Test>> start_tests_;  // necessary for the start

  // These belong to each_successor().
  std::vector<task::Word> before_, state_, next_;
  std::vector<task::ActionId> running_before_, running_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
