// A resumable search goes on where it stopped, so that several can take turns.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/call/named_goal.hpp"
#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl::search {

/// Holds how a search has ended: with a plan, or with the reason why there is none.
struct SearchOutcome {
  std::optional<PlanPrefix> plan;            ///< is none if there is no plan
  std::vector<task::Word> final_state;       ///< the state after the last step of the plan
  std::string reason;                        ///< what stood in the way, if there is no plan
  std::vector<call::BlockedFact> blocked{};  ///< which facts of the goals did, as far as is known
};

/// Defines the interface of the members of the portfolio.
class ResumableSearch {
 public:
  virtual ~ResumableSearch() = default;

  /// Goes on for as much work as so many evaluations are, and returns nothing if the search is not at its
  /// end yet. `bytes_elsewhere` count as used too. Throws what SearchLimits throws, and PlanningFailure
  /// (out_of_memory) if plans of more than kMaxSteps steps would have to be tried.
  virtual std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) = 0;
  /// Returns whether there is no plan if the search finds none.
  virtual bool complete() const = 0;
  /// Returns the bytes of the search, without those of the guide, which all searches share.
  virtual std::size_t bytes() const = 0;
};

}  // namespace roci::planner::temporal_pddl::search
