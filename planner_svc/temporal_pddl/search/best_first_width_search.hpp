// Best-first width search (Lipovetzky and Geffner 2017, BFWS(f5)) takes first the states that are newest
// among those with as many goals open and as much reached of a relaxed plan; among equally new ones it takes
// those with the fewest goals open. Where no fact and no pair of facts is new, a state is left out; so the
// search ends.
//
// A relaxed plan is asked for only where more goals hold than before, and every other state is cheap. So the
// search gets over plateaus, and out of corners, where estimates lead nowhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/dominance.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/pair_novelty.hpp"
#include "planner_svc/temporal_pddl/search/ranked_queue.hpp"
#include "planner_svc/temporal_pddl/search/resumable_search.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::search {

/// Searches by novelty; it is not complete.
class BestFirstWidthSearch final : public ResumableSearch {
 public:
  /// Prepares the search, which keeps the statistics of the context up to date all the time.
  BestFirstWidthSearch(const SearchContext& context, const Guide& guide, task::ActionCompression compression);

  /// Counts a number of states as one evaluation. The search ends without a plan where nothing is new any
  /// more, or when it has used a quarter of the memory that there is.
  std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) override;
  bool complete() const override { return false; }
  std::size_t bytes() const override;

 private:
  // Is a state in which more goals held than before.
  struct Milestone {
    std::size_t steps = 0;             // of the plan to it
    std::vector<task::FactId> wanted;  // what its relaxed plan adds
  };
  struct Progress {
    std::uint32_t milestone = 0;  // the last one on the way
    std::uint32_t open_goals = 0;
    std::uint32_t reached = 0;  // of what the milestone's relaxed plan adds
  };

  bool expand(NodeId node);
  bool reach(NodeId parent);
  std::optional<Progress> progress(NodeId parent);
  std::optional<std::uint32_t> set_milestone();
  void account(std::size_t work);
  std::uint32_t open_goals(task::StateView state) const;
  void look_back();
  std::uint32_t newly_reached();
  void list_facts(task::StateView state, std::span<const task::ActionId> running,
                  std::vector<std::uint32_t>& facts) const;
  int novelty(const Progress& progress, NodeId parent);

  SearchContext context_;
  const task::Task& task_;
  Guide guide_;
  task::Semantics semantics_;
  StateSpace space_;
  GoalTest goal_;
  Dominance dominance_;
  Evaluation evaluation_;
  PairNovelty novelty_;
  RankedQueue<NodeId> open_;
  std::vector<Progress> progress_;  // by node
  std::vector<Milestone> milestones_;
  std::size_t milestone_bytes_ = 0;
  std::uint64_t seed_;
  std::mt19937_64 random_;
  std::size_t work_ = 0;  // in states

  // These belong to the state that is expanded.
  PlanPrefix prefix_;
  std::vector<task::SnapId> candidates_;
  task::IdVector<task::FactId, bool> missing_;  // wanted by its milestone and not reached since
  std::vector<bool> held_;                      // by fact and running action
  std::vector<std::uint32_t> facts_;            // the same

  Successor successor_;
  heuristics::Estimate estimate_;
  std::vector<task::FactId> news_;
  std::vector<std::uint32_t> successor_facts_, fresh_;
};

}  // namespace roci::planner::temporal_pddl::search
