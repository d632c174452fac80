// The transition graph has all states that a timeline can come to by its transitions alone, and which of them
// lead to which.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "planner_svc/timeline_htn/search/ground.hpp"

namespace roci::planner::timeline_htn::search {

/// Holds the states of a component that transitions lead to from one, cut into parts within which each leads to each
/// other (strongly connected components, after Tarjan).
class TransitionGraph {
 public:
  TransitionGraph(Ground& ground, StateId from);

  const std::vector<StateId>& states() const { return states_; }
  /// Returns the part of a state; kNone: no transitions lead to it.
  Index part(StateId state) const { return state < part_.size() ? part_[state] : kNone; }
  /// Returns of each part whether transitions lead from it to this one. A part leads to itself.
  const std::vector<bool>& leading_to(Index part);
  std::size_t bytes() const { return bytes_; }

 private:
  void find_parts(Ground& ground, StateId from);

  std::vector<StateId> states_;
  std::vector<Index> part_;                // by state
  std::vector<std::vector<Index>> edges_;  // from part to part; a part leads to those with lower numbers
  std::map<Index, std::vector<bool>> leading_;
  std::size_t bytes_ = 0;
};

}  // namespace roci::planner::timeline_htn::search
