// Last states say in which state a timeline can stand when a behaviour is complete: what its last part leaves
// it in.
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner_svc/timeline_htn/search/successors.hpp"

namespace roci::planner::timeline_htn::search {

/// Knows nothing of how a timeline was before, nor of time: only which parts may move it, and which of them comes last.
class LastStates {
 public:
  LastStates(Ground& ground, const Successors& successors) : ground_(&ground), successors_(&successors) {}

  /// Says what a behaviour leaves a timeline in.
  struct Left {
    bool touched = false;                        ///< whether it may move the timeline at all
    std::optional<std::vector<StateId>> states;  ///< nothing: in any that it came to
  };
  /// Returns it for a behaviour of which these are the parts that a plan reckons with, in the order of its subgoals.
  Left of(Index behaviour, const std::vector<StateId>& parts, Index component);

 private:
  std::optional<std::vector<StateId>> of_part(StateId part, Index component);
  bool stays(StateId state);
  std::optional<std::vector<StateId>> of_ways(StateId state, Index component);
  bool moves(Index by, Index component) const { return (ground_->moved_by(by) >> component & 1U) != 0; }

  Ground* ground_;
  const Successors* successors_;
  std::set<StateId> above_;  // complex states of which the parts are being looked at
};

}  // namespace roci::planner::timeline_htn::search
