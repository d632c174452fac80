// Of a disjunctive goal one alternative at a time is searched for.
//
// An estimate for a goal with alternatives is that of the one which seems nearest, and a step towards one often makes
// another one seem nearer: a search may so go to and fro between them. Who has set his mind on one is not led astray.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

#include "planner_svc/temporal_pddl/search/resumable_search.hpp"
#include "planner_svc/temporal_pddl/search/search_context.hpp"

namespace roci::planner::temporal_pddl::search {

/// Searches for each alternative by best-first search with lookahead, one after the other, and then again with twice as
/// many evaluations. It is not complete.
class GoalAlternatives final : public ResumableSearch {
 public:
  /// Returns whether the goal has as many alternatives as it pays to search for singly.
  static bool has_some(const task::Task& task);

  GoalAlternatives(const SearchContext& context, const Guide& guide, task::ActionCompression compression);
  ~GoalAlternatives() override;

  std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) override;
  bool complete() const override { return false; }
  std::size_t bytes() const override;

 private:
  struct Attempt;

  SearchContext context_;
  Guide guide_;
  task::ActionCompression compression_;
  std::deque<std::size_t> open_;  // of the goal's alternatives, in the order of their turns
  std::size_t turns_left_;        // until all have had one
  std::size_t budget_;            // of an attempt
  std::unique_ptr<Attempt> attempt_;
};

}  // namespace roci::planner::temporal_pddl::search
