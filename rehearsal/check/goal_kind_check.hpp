// This file checks goal kinds of a mission file: templates, timelines, and facts that something must bring
// about.
#pragma once

#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of slots that are no argument of their kind, of timelines and states in conditions that nobody tells
/// of, and of goal facts for which no state of a component or family stands: such a goal would never be seen as
/// achieved.
void check_goal_kinds(const CheckedMission& mission, const CheckedExecutive& executive);

}  // namespace roci::rehearsal::check
