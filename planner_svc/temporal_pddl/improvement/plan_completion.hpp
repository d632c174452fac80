// Plan completion completes the beginning of a plan by best-first search over preferred successors, led by
// how long the whole will take. It is the repair of large neighbourhood search.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/temporal/duration.hpp"
#include "planner_svc/temporal_pddl/improvement/plan_quality.hpp"
#include "planner_svc/temporal_pddl/improvement/relaxed_schedule.hpp"
#include "planner_svc/temporal_pddl/improvement/weighted_a_star.hpp"
#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::improvement {

/// Says what leads a completion, and how far.
struct CompletionRule {
  bool tries_schedule = false;  ///< whether what RelaxedSchedule prefers is tried too
  /// Says whether it goes first by how soon all can be over, else by what is done and what is to come.
  bool by_makespan = false;
  bool lookahead = false;       ///< whether the plan of that schedule is followed as far as it goes
  std::int64_t weight = 1;      ///< the weight of what is to come
  std::size_t evaluations = 0;  ///< bounds how many there are
};

/// Completes one beginning after the other and keeps its memory in between.
class PlanCompletion {
 public:
  explicit PlanCompletion(const search::SearchContext& context);

  /// Returns a plan that starts with the given steps and whose metric and makespan are no worse than those
  /// of `bound`; or nothing if none was found with so many evaluations. Throws what SearchLimits throws.
  std::optional<search::PlanPrefix> find(std::span<const task::SnapId> beginning, const PlanQuality& bound,
                                         const search::Guide& guide, const CompletionRule& rule);
  /// Returns how many evaluations the last find() took.
  std::size_t evaluated() const { return evaluated_; }

 private:
  struct Entry {
    std::int64_t total = 0;
    std::int64_t steps = 0;
    std::size_t number = 0;  // in order of generation
    search::NodeId node;
    std::vector<task::SnapId> preferred;
    // Orders worse before better, so that a heap has the best at its top.
    bool operator<(const Entry& other) const {
      return std::tie(total, steps, number) > std::tie(other.total, other.steps, other.number);
    }
  };

  void restart();
  bool begin(std::span<const task::SnapId> beginning);
  bool complete();
  bool advance(const search::PlanPrefix& prefix, task::SnapId snap);
  bool follow_schedule();
  bool take_up();
  temporal::Duration relaxed_makespan();

  search::SearchContext context_;
  const task::Task& task_;
  bool only_grows_;
  search::Evaluation evaluation_;
  RelaxedSchedule relaxed_schedule_;
  constraints::ReleaseTimes release_times_;
  std::vector<temporal::Duration> started_;
  search::StateSpace space_;
  search::GoalTest goal_;
  search::Dominance dominance_;

  PlanQuality bound_;
  const search::Guide* guide_ = nullptr;
  CompletionRule rule_;
  std::vector<Entry> open_;  // a heap
  search::PlanPrefix prefix_;
  search::Successor successor_, kept_;
  std::vector<task::SnapId> way_;
  heuristics::Estimate estimate_;
  std::size_t evaluated_ = 0;
  std::size_t generated_ = 0;
};

}  // namespace roci::planner::temporal_pddl::improvement
