// This file checks scenarios against the mission: their goals, windows, starts and the events that they
// expect.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of goals that would be rejected (unless the scenario expects goal.rejected) or stand twice, windows that
/// the mission does not have, states at the start that the mission does not know, codes of events that nobody tells,
/// and goals under `expect` that nobody sends. What can be meant is noted as a warning: a goal that is sent again
/// later.
void check_scenario(const CheckedMission& mission, const CheckedScenario& scenario,
                    mission::Findings& findings);

/// A goal as the scenario sends it.
exec::goals::GoalRequest request_of(const sim::scenario::GoalStimulus& goal);

}  // namespace roci::rehearsal::check
