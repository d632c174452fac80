// Makes a complete plan of the beginning of one: best-first search over preferred successors, led by how long
// the whole will take.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/improvement/earliest_finish.hpp"
#include "planner_svc/temporal_pddl/improvement/quality.hpp"
#include "planner_svc/temporal_pddl/improvement/weighted_search.hpp"
#include "planner_svc/temporal_pddl/options.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"
#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

// What leads a completion, and how far.
struct CompletionRule {
  bool looks_out = false;       // what EarliestFinish prefers is tried too
  bool by_finish = false;       // first by how soon all can be over, else by what is done and what is to come
  bool ahead = false;           // and its relaxed plan is followed as far as it goes
  std::int64_t weight = 1;      // of what is to come
  std::size_t evaluations = 0;  // at most
};

class Completion {
 public:
  Completion(const Task& task, const Options& options, Watch& watch, Statistics& statistics);

  // A plan that starts with the given steps and whose metric and makespan are no worse than those of `bound`;
  // none: not found with so many evaluations. Throws what Watch throws.
  std::optional<PlanPrefix> find(std::span<const SnapId> beginning, const Quality& bound, const Guide& guide,
                                 const CompletionRule& rule);
  // Of the last find().
  std::size_t evaluated() const { return evaluated_; }

 private:
  struct Entry {
    std::int64_t total = 0;
    std::int64_t steps = 0;
    std::size_t number = 0;  // in order of generation
    NodeId node;
    std::vector<SnapId> preferred;
    // The worse one; for a heap.
    bool operator<(const Entry& other) const {
      return std::tie(total, steps, number) > std::tie(other.total, other.steps, other.number);
    }
  };

  void restart();
  bool begin(std::span<const SnapId> beginning);
  bool complete();
  bool advance(const PlanPrefix& prefix, SnapId snap);
  bool pursue();
  bool take_up();
  Ticks look_out();

  const Task& task_;
  Watch& watch_;
  Statistics& statistics_;
  bool only_grows_;
  Evaluation evaluation_;
  EarliestFinish earliest_finish_;
  TimeFreedom freedom_;
  std::vector<Ticks> started_;
  StateSpace space_;
  GoalTest goal_;
  Dominance dominance_;

  Quality bound_;
  const Guide* guide_ = nullptr;
  CompletionRule rule_;
  std::vector<Entry> open_;  // a heap
  PlanPrefix prefix_;
  Successor successor_, kept_;
  std::vector<SnapId> way_;
  Estimate estimate_;
  std::size_t evaluated_ = 0;
  std::size_t generated_ = 0;
};

}  // namespace roci::planner::temporal_pddl
