// Goal serialization reaches and keeps one goal after the other.
//
// From the best state so far, the relaxed plan of a single goal is followed, again and again, until the goal
// holds; then that of the next goal, and never back (in the manner of PROBE, Lipovetzky and Geffner 2011). A
// state is better if it keeps more goals.
//
// A goal is kept if it holds and no relaxed plan of an open one needs it undone. An open goal waits as long
// as the relaxed plan of another needs what is inconsistent with it (reasonable orders, Koehler and Hoffmann
// 2000). So hundreds of goals that are independent of each other, but for what their actions share, take a
// few evaluations each. Where that leads nowhere the search ends soon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/search/evaluation.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/lookahead.hpp"
#include "planner_svc/temporal_pddl/search/resumable_search.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"

namespace roci::planner::temporal_pddl::search {

/// Searches goal by goal; it is not complete.
class GoalSerialization final : public ResumableSearch {
 public:
  GoalSerialization(const SearchContext& context, const Guide& guide, heuristics::FfHeuristic& ff,
                    task::ActionCompression compression);

  std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) override;
  bool complete() const override { return false; }
  std::size_t bytes() const override { return space_.store().bytes(); }

 private:
  struct Subgoal {
    bool waits = false;  // for another goal
    std::int64_t distance = 0;
    task::FactId goal;
    std::vector<task::SnapId> plan = {};
  };
  enum class Step { further, in_vain, found };

  bool begin();
  Step follow();
  bool look_at();
  bool survey();
  void mark_undone(std::span<const task::SnapId> plan, std::size_t goal);
  void take_up(std::size_t subgoal);

  SearchContext context_;
  const task::Task& task_;
  Guide guide_;
  heuristics::FfHeuristic& ff_;
  StateSpace space_;
  GoalTest goal_test_;
  Evaluation evaluation_;
  Lookahead lookahead_;
  std::vector<task::FactId> goals_;
  std::vector<std::vector<std::uint32_t>> goals_of_;  // by variable
  std::vector<bool> undone_;                          // by goal: by another one's relaxed plan

  Successor base_;                 // the best so far
  std::size_t kept_ = 0;           // goals in it
  std::vector<Subgoal> subgoals_;  // from it, the most promising first

  // These belong to the subgoal at hand.
  std::size_t subgoal_ = 0;
  Successor state_, next_;
  std::vector<task::SnapId> plan_;
  std::int64_t nearest_ = 0;
  int in_vain_ = 0;

  std::size_t evaluated_ = 0;
};

}  // namespace roci::planner::temporal_pddl::search
