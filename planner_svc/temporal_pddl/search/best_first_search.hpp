// Greedy best-first search defers evaluation: a state is evaluated when it is taken up, and its successors
// wait with its estimate (Helmert 2006, section 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/lookahead.hpp"
#include "planner_svc/temporal_pddl/search/novelty.hpp"
#include "planner_svc/temporal_pddl/search/open_list.hpp"
#include "planner_svc/temporal_pddl/search/resumable_search.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::search {

/// Says how a best-first search takes its steps.
struct SearchStyle {
  task::ActionCompression steps = task::ActionCompression::where_safe;
  bool lookahead = false;  ///< whether relaxed plans are followed
};

/// Searches by estimates; it is complete where it compresses only what is safe.
class BestFirstSearch final : public ResumableSearch {
 public:
  /// Prepares the search, which keeps the statistics of the context up to date all the time.
  BestFirstSearch(const SearchContext& context, const Guide& guide, SearchStyle style);

  std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) override;
  bool complete() const override { return complete_; }
  std::size_t bytes() const override {
    return space_.store().bytes() + open_.bytes() + dominance_.bytes() + novelty_.bytes();
  }

 private:
  SearchOutcome found();
  SearchOutcome failed() const;
  bool reach(NodeId parent);
  bool take_up();
  bool look_ahead(bool careful);
  Priority by_plan() const { return {estimate_.steps, estimate_.cost}; }
  void expand(const PlanPrefix& prefix);
  void account();

  SearchContext context_;
  const task::Task& task_;
  Guide guide_;
  bool follows_plans_;
  bool complete_;
  StateSpace space_;
  GoalTest goal_;
  Dominance dominance_;
  bool dominate_;
  Evaluation evaluation_;
  OpenList open_;
  Novelty novelty_;
  Lookahead lookahead_;
  std::mt19937_64 random_;

  PlanPrefix prefix_;  // of the entry's parent
  Successor successor_;
  Successor ahead_;
  heuristics::Estimate estimate_;
  Priority best_plan_{std::numeric_limits<std::int64_t>::max(), 0};
  std::int64_t best_landmarks_ = std::numeric_limits<std::int64_t>::max();
  std::vector<task::SnapId> candidates_;
  std::size_t evaluated_ = 0;
  std::size_t bytes_elsewhere_ = 0;
  bool too_long_ = false;
};

}  // namespace roci::planner::temporal_pddl::search
