// These functions take in what the ground and the world say, before anything is decided: goals, and facts
// that achieve them.
#pragma once

#include "exec_svc/reactor/mission_state.hpp"

namespace roci::exec::reactor {

/// Takes requests for goals in; each is answered by a change of its goal's status. Returns whether one was
/// accepted, so that a plan is wanted for it.
bool take_goals(MissionState& state, temporal::Time now, const std::vector<goals::GoalRequest>& requests);

/// Takes in what another executive that led apart has of goals, with recalls, changes and ends. Returns whether
/// one is newly open, so that a plan is wanted for it.
bool take_handed_over(MissionState& state, const std::vector<goals::GoalRecord>& records);

/// Assumes the timelines that the goal brings with it to be as its kind says, until they are observed.
void assume_unobserved(MissionState& state, const goals::GoalRequest& goal);

/// Marks open goals as achieved whose success is observed, whoever brought it about.
void note_achieved(MissionState& state, temporal::Time now);

}  // namespace roci::exec::reactor
