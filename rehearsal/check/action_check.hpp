// This file checks actions and contingencies of a mission file: their owners, commands, arguments and
// properties.
#pragma once

#include "rehearsal/check/checked_mission.hpp"

namespace roci::rehearsal::check {

/// Complains of owners that are no services, commands that a simulated component does not have or that lack an
/// argument, positions beyond the action's parameters, properties that no object has, and objects that lack
/// one which an action's command takes.
void check_actions(const CheckedMission& mission, const CheckedExecutive& executive);

}  // namespace roci::rehearsal::check
