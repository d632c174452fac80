// Scenarios against the mission: their goals, windows, starts and the events that they expect.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of goals that would be rejected (unless the scenario expects goal.rejected), windows that the mission
/// does not have, states at the start that the mission does not know, and codes of events that nobody tells.
void check_scenario(const CheckedMission& mission, const CheckedScenario& scenario);

/// A goal as the scenario sends it.
exec::goals::GoalRequest request_of(const sim::scenario::GoalStimulus& goal);

}  // namespace roci::rehearsal::check
